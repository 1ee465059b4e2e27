/* A study computes numbers, a table and shapes from a Def. studies.def lists the studies. */
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
  double value;     /* NAN if it does not exist (null in JSON) */
  bool timing;      /* a wall time, which differs from run to run */
} ZpScalar;

/* A derivative of an output by a key of sensitivity.by, exact except for rounding. */
typedef struct ZpSensitivity {
  const char *output; /* name of a scalar: "stroke_m" */
  int key;            /* index of the key */
  double value;       /* in SI units of both; NAN if it does not exist */
} ZpSensitivity;

/* The electric field around the ribbons, on a grid that follows them: node (i, j) is at [i * ny + j], i along the
 * ribbons, j upwards; cell (i, j) between the nodes (i, j) and (i + 1, j + 1) is at [i * (ny - 1) + j]. */
typedef struct ZpFieldMap {
  size_t nx, ny;        /* of nodes */
  double *x, *y;        /* [nx ny] m */
  double *potential;    /* [nx ny] V */
  double *strength;     /* [(nx - 1) (ny - 1)] field strength in the middle of a cell, V/m */
  double *permittivity; /* [(nx - 1) (ny - 1)] relative permittivity of a cell; 0 in metal */
  size_t surface[6];    /* j of the nodes on the lower metal's underside and top, the lower and the upper insulator
                         * face, the upper metal's underside and top */
  void *memory;
} ZpFieldMap;

/* NULL if there is no memory. */
ZP_API ZpFieldMap *zp_field_map_create(size_t nx, size_t ny);
ZP_API void zp_field_map_destroy(ZpFieldMap *map);

/* The result of a study. */
typedef struct ZpResult ZpResult;

/* The word for a study: "actuate"; "unknown" for any other number. */
ZP_API const char *zp_study_name(ZpStudy study);

/* Can a run of `study` start from the result of a neighbour (ZpStudyInput)? The bits of its result then depend on it.
 */
ZP_API bool zp_study_follows(ZpStudy study);

/* Check `def` and the conditions of `study` on it. ZP_BAD_INPUT names the key. */
ZP_API ZpStatus zp_study_check(ZpStudy study, const ZpActuatorDef *def, ZpError *err);

/* Inputs of a study in addition to a Def; NULL if there is none. */
typedef struct ZpStudyInput {
  const ZpDriveTable *table; /* actuate: with drive.waveform or setpoint.waveform table, as zp_model_create_driven */
  const ZpCheckpoint *start; /* actuate: with initial.state checkpoint, as zp_sim_continue */
  const ZpResult *neighbour; /* limits: the result of a similar Def, from whose states the study starts; this is several
                              * times faster, and results differ by less than 1e-6 */
} ZpStudyInput;

/* Run `study`. On ZP_OK *result is new and belongs to the caller, whatever its outcome; otherwise it is NULL and `err`
 * gives the reason: ZP_BAD_INPUT as zp_study_check, and for study calibrate, which needs a file (zp_data_study_run).
 * `input` and `hooks` may be NULL. */
ZP_API ZpStatus zp_study_run(ZpStudy study, const ZpActuatorDef *def, const ZpStudyInput *input, const ZpHooks *hooks,
                             ZpResult **result, ZpError *err);

/* An empty result of `study`; NULL if there is no memory. */
ZP_API ZpResult *zp_result_create(ZpStudy study);

/* Append the derivative of the scalar `output` by key `key`; beyond 512 it is omitted. `output` must
 * outlive the result. */
ZP_API void zp_result_add_sensitivity(ZpResult *result, const char *output, int key, double value);

/* Append a number to the summary, a wall time, or a note of one sentence of any length. Beyond 64 numbers and 8 notes
 * they are omitted; a study that has no memory for a note fails. `name` and `unit` must outlive the result. */
ZP_API void zp_result_add(ZpResult *result, const char *name, const char *unit, double value);
ZP_API void zp_result_add_timing(ZpResult *result, const char *name, const char *unit, double value);
/* Append a number of one of several: what it is called stands in the place of # in the name, which is copied. */
ZP_API void zp_result_add_of(ZpResult *result, const char *name, const char *called, const char *unit, double value);
ZP_API void zp_result_note(ZpResult *result, const char *format, ...) ZP_PRINTF(2, 3);

/* Add notes, for `model` at voltages up to `highest` (V), if the insulators break down at the clip, where the faces
 * touch, or if the mesh is too coarse. */
ZP_API void zp_result_note_model(ZpResult *result, const ZpModel *model, double highest);

/* Free the states of study limits in a result, from which that of a similar Def can start: much memory. Nothing else of
 * it changes. NULL is allowed. */
ZP_API void zp_result_forget_states(ZpResult *result);

/* Free a result and all its parts; NULL is allowed. */
ZP_API void zp_result_destroy(ZpResult *result);

/* The scalar called `name`, NAN if there is none. */
ZP_API double zp_result_get(const ZpResult *result, const char *name);

/* The study, how it ended, and one sentence on that. */
ZP_API ZpStudy zp_result_study(const ZpResult *result);
ZP_API ZpOutcome zp_result_outcome(const ZpResult *result);
ZP_API const char *zp_result_message(const ZpResult *result);

/* Number of notes, and note `index`, NULL from there on: a sentence on breakdown, yield, or limits of the model and of
 * the mesh. */
ZP_API size_t zp_result_notes(const ZpResult *result);
ZP_API const char *zp_result_note_text(const ZpResult *result, size_t index);

/* Number of elements on the shortest length over which a ribbon bends, at the zip front or at rest (theory, eqs. (9.4)
 * and (9.5)); below 1 no errors are estimated. INFINITY: no such length. */
ZP_API double zp_result_resolution(const ZpResult *result);

/* Number of scalars, and scalar `index`, NULL from there on, in the order of the summary. */
ZP_API size_t zp_result_scalars(const ZpResult *result);
ZP_API const ZpScalar *zp_result_scalar(const ZpResult *result, size_t index);

/* Number of derivatives, and derivative `index`, NULL from there on: key by key, in the order of sensitivity.by. */
ZP_API size_t zp_result_sensitivities(const ZpResult *result);
ZP_API const ZpSensitivity *zp_result_sensitivity(const ZpResult *result, size_t index);

/* The study's table, its shapes, its map of the field, and the checkpoint of a run in time, to resume from. They are
 * parts of the result; NULL if it has none. */
ZP_API const ZpTable *zp_result_series(const ZpResult *result);
ZP_API const ZpShapes *zp_result_shapes(const ZpResult *result);
ZP_API const ZpFieldMap *zp_result_map(const ZpResult *result);
ZP_API const ZpCheckpoint *zp_result_checkpoint(const ZpResult *result);

#ifdef __cplusplus
}
#endif

#endif
