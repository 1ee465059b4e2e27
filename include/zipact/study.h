/* A study: a Def goes in, numbers, a table and shapes come out. Which studies there are: studies.def. */
#ifndef ZIPACT_STUDY_H
#define ZIPACT_STUDY_H

#include <zipact/api.h>
#include <zipact/checkpoint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* One number of a summary. */
typedef struct ZpScalar {
  const char *name; /* "zip_time_s" */
  const char *unit; /* "s"; "1" for a pure number; "count" for a whole number */
  double value;     /* NAN where it does not exist (null in JSON) */
  bool timing;      /* follows from wall time: differs from run to run */
} ZpScalar;

#define ZP_MAX_SCALARS 64
#define ZP_MAX_NOTES   8

/* A derivative of an output by a key of sensitivity.by, exact but for rounding. */
typedef struct ZpSensitivity {
  const char *output; /* name of a scalar: "stroke_m" */
  int key;            /* index of the key */
  double value;       /* in SI units of both; NAN where it does not exist */
} ZpSensitivity;

/* Most keys of sensitivity.by, and most derivatives. */
#define ZP_MAX_SENSITIVITY_KEYS 16
#define ZP_MAX_SENSITIVITIES    512

/* The electric field around the ribbons, on a grid that follows them: node (i, j) is at [i * ny + j], i along the
 * ribbons, j upwards; cell (i, j) between the nodes (i, j) and (i + 1, j + 1) is at [i * (ny - 1) + j]. */
typedef struct ZpFieldMap {
  size_t nx, ny;        /* of nodes */
  double *x, *y;        /* [nx ny] m */
  double *potential;    /* [nx ny] V */
  double *strength;     /* [(nx - 1) (ny - 1)] of the field in the middle of a cell, V/m */
  double *permittivity; /* [(nx - 1) (ny - 1)] relative, of a cell; 0 in metal */
  size_t surface[6];    /* j of the nodes on the lower metal's underside and top, the lower and the upper insulator
                         * face, the upper metal's underside and top */
  void *memory;
} ZpFieldMap;

/* NULL if there is no memory. */
ZP_API ZpFieldMap *zp_field_map_create(size_t nx, size_t ny);
ZP_API void zp_field_map_destroy(ZpFieldMap *map);

/* What study limits keeps for a neighbour, see ZpStudyInput. */
typedef struct ZpLimits ZpLimits;

/* Free them; NULL is allowed. Whoever frees those of a result sets its field to NULL. */
ZP_API void zp_limits_destroy(ZpLimits *limits);

/* What a study found. */
typedef struct ZpResult {
  ZpStudy study;
  ZpOutcome outcome;
  char message[256]; /* one sentence on how it ended */
  char note[ZP_MAX_NOTES]
           [256]; /* [notes] sentences: breakdown, yield, limits of the model and of the mesh that were met */
  size_t notes;
  double resolution; /* elements on the shortest length over which a ribbon bends, of the zip front or where it hangs
                      * (theory, eqs. (9.4) and (9.5)); below 1 no errors are estimated. INFINITY: no such length */
  ZpScalar scalar[ZP_MAX_SCALARS]; /* in the order of the summary */
  size_t scalars;
  ZpSensitivity sensitivity[ZP_MAX_SENSITIVITIES]; /* key by key, in the order of sensitivity.by */
  size_t sensitivities;
  ZpTable *series;          /* the study's table; NULL if it has none */
  ZpShapes *shapes;         /* NULL if it has none */
  ZpFieldMap *map;          /* NULL if it has none */
  ZpCheckpoint *checkpoint; /* of a run in time, to resume from; NULL if there is none */
  ZpLimits *limits;         /* the states of study limits; NULL of another */
} ZpResult;

/* The word of a study: "actuate"; "unknown" of any other number. */
ZP_API const char *zp_study_name(ZpStudy study);

/* Whether a run of `study` may start from the result of a neighbour (ZpStudyInput); then its bits depend on it. */
ZP_API bool zp_study_follows(ZpStudy study);

/* Check `def` and what `study` asks of it besides. ZP_BAD_INPUT names the key. */
ZP_API ZpStatus zp_study_check(ZpStudy study, const ZpActuatorDef *def, ZpError *err);

/* What a study takes beside a Def; NULL where it does not. */
typedef struct ZpStudyInput {
  const ZpDriveTable *table; /* actuate: with drive.waveform or setpoint.waveform table, as zp_model_create_driven */
  const ZpCheckpoint *start; /* actuate: with initial.state checkpoint, as zp_sim_continue */
  const ZpResult *neighbour; /* limits: the result of a Def that differs little: it starts from its states, some
                                       times faster; what it finds differs by less than 1e-6 */
} ZpStudyInput;

/* Run `study`. On ZP_OK *result is new and the caller's, whatever its outcome; else it is NULL and `err` says why:
 * ZP_BAD_INPUT as zp_study_check, and of study calibrate, which needs a file (zp_data_study_run). `input` and `hooks`
 * may be NULL. */
ZP_API ZpStatus zp_study_run(ZpStudy study, const ZpActuatorDef *def, const ZpStudyInput *input, const ZpHooks *hooks,
                             ZpResult **result, ZpError *err);

/* A result of `study` without anything in it, for whoever fills one; NULL if there is no memory. */
ZP_API ZpResult *zp_result_create(ZpStudy study);

/* Append the derivative of the scalar `output` by key `key`; beyond ZP_MAX_SENSITIVITIES it is left out. `output` must
 * outlive the result. */
ZP_API void zp_result_add_sensitivity(ZpResult *result, const char *output, int key, double value);

/* Append a number to the summary; one that follows from wall time; a sentence of note. Beyond ZP_MAX_SCALARS and
 * ZP_MAX_NOTES they are left out. `name` and `unit` must outlive the result. */
ZP_API void zp_result_add(ZpResult *result, const char *name, const char *unit, double value);
ZP_API void zp_result_add_timing(ZpResult *result, const char *name, const char *unit, double value);
ZP_API void zp_result_note(ZpResult *result, const char *format, ...) ZP_PRINTF(2, 3);

/* Note breakdown where the faces of two ribbons touch, at the clip, and a mesh that is too coarse, for `model` under
 * voltages up to `highest` (V). */
ZP_API void zp_result_note_model(ZpResult *result, const ZpModel *model, double highest);

/* Free a result with all that it holds; NULL is allowed. */
ZP_API void zp_result_destroy(ZpResult *result);

/* The scalar called `name`, NAN if there is none. */
ZP_API double zp_result_get(const ZpResult *result, const char *name);

#ifdef __cplusplus
}
#endif

#endif
