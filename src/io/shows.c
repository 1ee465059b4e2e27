#include "io/shows.h"

ZpShows zp_study_shows(ZpStudy study) {
  static const ZpShows of[ZpStudy_COUNT] = {
#define ZP_STUDY(enumerator, word, shows, files, help) [enumerator] = ZP_SHOWS_##shows,
#include <zipact/studies.def>
  };
  return of[study];
}
