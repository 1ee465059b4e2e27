/* The inside of a result, which only the library and its tests see. */
#ifndef ZP_STUDY_RESULT_H
#define ZP_STUDY_RESULT_H

#include <zipact/study.h>

#include "base/table.h"

/* Largest numbers of notes, keys of sensitivity.by and derivatives. */
enum { ZP_MAX_NOTES = 8, ZP_MAX_SENSITIVITY_KEYS = 16, ZP_MAX_SENSITIVITIES = 512 };

/* A name that a result owns, and the next one. */
typedef struct ZpName {
  struct ZpName *next;
  char text[];
} ZpName;

/* States of study limits from which a similar case can start, see ZpStudyInput. */
typedef struct ZpLimits ZpLimits;

/* Free them; NULL is allowed. */
void zp_limits_destroy(ZpLimits *limits);

/* Tables of a single run beside its series, each with a file of its own: NAME.csv. */
typedef enum ZpFurther {
  ZP_FURTHER_LIKELIHOOD, /* calibrate: how the sum of squares rises with each fitted parameter */
  ZP_FURTHER_REGIONS,    /* calibrate: the joint 95 % region of each pair of parameters */
  ZP_FURTHER
} ZpFurther;

extern const char *const zp_further_name[ZP_FURTHER];

/* Free the further tables of a result. */
void zp_result_forget_further(ZpResult *result);

/* Take away the notes. */
void zp_result_forget_notes(ZpResult *result);

/* Take away scalars, derivatives, notes and the table. */
void zp_result_clear(ZpResult *result);

/* Add a derivative of a scalar of this name, which zp_result_add_of has added; nothing where none has. */
void zp_result_add_sensitivity_of(ZpResult *result, const char *name, const char *called, int key, double value);

/* The result of a study. */
struct ZpResult {
  ZpStudy study;
  ZpOutcome outcome;
  char message[256];        /* one sentence on how it ended */
  char *note[ZP_MAX_NOTES]; /* [notes] sentences on breakdown, yield, and limits of the model and of the mesh */
  size_t notes;
  bool incomplete;   /* there was no memory for a note or a scalar */
  double resolution; /* number of elements on the shortest length over which a ribbon bends, at the zip front or at rest
                      * (theory, eqs. (9.4) and (9.5)); below 1 no errors are estimated. INFINITY: no such length */
  ZpScalar *scalar;  /* [scalars] in the order of the summary */
  size_t scalars, scalar_room;
  ZpName *names; /* of scalars of members */
  ZpSensitivity
      sensitivity[ZP_MAX_SENSITIVITIES]; /* of all key by key, in the order of sensitivity.by, then of parts */
  bool cut;                              /* there was no room for another one */
  size_t sensitivities;
  ZpTable *series;              /* the study's table; NULL if it has none */
  ZpTable *further[ZP_FURTHER]; /* NULL where it has none */
  ZpShapes *shapes;             /* NULL if it has none */
  ZpFieldMap *map;              /* NULL if it has none */
  ZpCheckpoint *checkpoint;     /* of a run in time, to resume from; NULL if there is none */
  ZpLimits *limits;             /* the states of study limits; NULL for other studies */
};

#endif
