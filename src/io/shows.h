/* What the results of a study are: says which pictures, and which words in the files, fit. Made from studies.def, so no
 * writer knows which studies there are. */
#ifndef ZP_IO_SHOWS_H
#define ZP_IO_SHOWS_H

#include <zipact/def.h>

typedef enum ZpShows {
  ZP_SHOWS_motion,      /* rows and shapes over time */
  ZP_SHOWS_branch,      /* states of rest along the voltage */
  ZP_SHOWS_held_branch, /* the same, the platform held: no load, but a force */
  ZP_SHOWS_shape,       /* one shape at rest */
  ZP_SHOWS_modes,       /* the shape at rest, then one with each mode on it */
  ZP_SHOWS_field,       /* forces along one shape, and the field around it */
  ZP_SHOWS_fit,         /* measured and fitted values */
  ZP_SHOWS_limits       /* single states, each a limit of another kind */
} ZpShows;

ZpShows zp_study_shows(ZpStudy study);

#endif
