/* The kind of results of a study: it determines pictures and words in files. Made from studies.def, so no writer knows
 * the studies. */
#ifndef ZP_IO_SHOWS_H
#define ZP_IO_SHOWS_H

#include <zipact/def.h>

typedef enum ZpShows {
  ZP_SHOWS_motion,      /* rows and shapes over time */
  ZP_SHOWS_branch,      /* equilibria along the voltage */
  ZP_SHOWS_held_branch, /* the same with a held platform: a force instead of a load */
  ZP_SHOWS_shape,       /* one shape at rest */
  ZP_SHOWS_modes,       /* the shape at rest, then one shape per mode */
  ZP_SHOWS_field,       /* forces along one shape, and the field around it */
  ZP_SHOWS_fit,         /* measured and fitted values */
  ZP_SHOWS_limits       /* single states, each of them a limit */
} ZpShows;

ZpShows zp_study_shows(ZpStudy study);

/* Its kind as a word: "held_branch". */
const char *zp_study_kind(ZpStudy study);

#endif
