#include "io/shows.h"
#include "def/def.h"

static const struct {
  ZpShows shows;
  const char *word;
} of[ZpStudy_COUNT] = {
#define ZP_STUDY(enumerator, word, shows, files, help) [enumerator] = {ZP_SHOWS_##shows, #shows},
#include <zipact/studies.def>
};

ZpShows zp_study_shows(ZpStudy study) {
  return of[study].shows;
}

const char *zp_study_kind(ZpStudy study) {
  return of[study].word;
}
