/* Files: scenarios in, results out. The only part that knows units other than SI, file names and
 * pictures. Needs libfyaml, UDUNITS-2, jansson and HDF5, and gnuplot when it draws. */
#ifndef ZIPACT_IO_H
#define ZIPACT_IO_H

#include <stdio.h>

#include <zipact/api.h>
#include <zipact/study.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A scenario: values for keys, some of them lists or distributions. The product of its lists and the samples of its
 * distributions are a set of Defs. */
typedef struct ZpScenario ZpScenario;

/* A new scenario in which every key has its default. NULL if there is no memory. */
ZP_API ZpScenario *zp_scenario_create(void);
ZP_API void zp_scenario_destroy(ZpScenario *scenario);

/* Read a YAML file into `scenario`. ZP_BAD_INPUT names file, line, key, value, unit, range and the
 * nearest known key, also a file that does not exist; ZP_MACHINE if it cannot be read. On failure `scenario` is as
 * before. */
ZP_API ZpStatus zp_scenario_read(ZpScenario *scenario, const char *path, ZpError *err);

/* The same from `size` bytes in memory; `name` stands for the file in messages. */
ZP_API ZpStatus zp_scenario_parse(ZpScenario *scenario, const char *text, size_t size, const char *name, ZpError *err);

/* As zp_scenario_parse, but what it gives wins over files and --set alike, as long as no other --set comes. */
ZP_API ZpStatus zp_scenario_override(ZpScenario *scenario, const char *text, size_t size, const char *name,
                                     ZpError *err);

/* Set from "KEY=VALUE" as --set gives it; wins over the file. VALUE as in YAML, a list "[1, 2]" too. */
ZP_API ZpStatus zp_scenario_set(ZpScenario *scenario, const char *assignment, ZpError *err);

/* How many Defs the scenario stands for: the product of the lengths of its lists (1 without lists), of those of
 * sampling.together once, times the samples of its distributions. */
ZP_API size_t zp_scenario_count(const ZpScenario *scenario);

/* Keys that have lists or distributions, in key order; *count of them. Valid until the scenario changes. */
ZP_API const int *zp_scenario_lists(const ZpScenario *scenario, size_t *count);

/* Whether `key`, which has a unit, was given as a number without one, other than 0: then it was taken as SI, and *value
 * is the first such value, SI. */
ZP_API bool zp_scenario_bare_number(const ZpScenario *scenario, int key, double *value);

/* Whether the results of a sweep keep their series: output.series. */
ZP_API bool zp_scenario_keeps_series(const ZpScenario *scenario);

/* The study of the scenario, the same for all its Defs. */
ZP_API ZpStudy zp_scenario_study(const ZpScenario *scenario);

/* As zp_scenario_def, where def->layout is set already: for that function. ZP_BAD_INPUT if it is not the library's. */
ZP_API ZpStatus zp_scenario_fill(const ZpScenario *scenario, size_t index, ZpActuatorDef *def, ZpError *err);

/* Def number `index`, resolved (zp_def_resolve) and checked (zp_study_check). Samples vary fastest,
 * then the last list key. */
static inline ZpStatus zp_scenario_def(const ZpScenario *scenario, size_t index, ZpActuatorDef *def, ZpError *err) {
  def->layout = zp_def_layout();
  return zp_scenario_fill(scenario, index, def, err);
}

/* Write the scenario as YAML, all keys as resolved, lists as lists: it reads back to the same bits. */
ZP_API ZpStatus zp_scenario_write(const ZpScenario *scenario, FILE *file, ZpError *err);

/* Write the table of keys: for people, as JSON, as a starter scenario with help as comments, or as a JSON schema of
 * scenarios (draft 7), with which editors complete and check them. */
typedef enum ZpKeysFormat { ZP_KEYS_TEXT, ZP_KEYS_JSON, ZP_KEYS_YAML, ZP_KEYS_SCHEMA } ZpKeysFormat;
ZP_API ZpStatus zp_keys_write(ZpKeysFormat format, FILE *file, ZpError *err);

/* Read a value for key `index` as a person writes it: "130 um", "auto", "true", "plates"; a bare number
 * is SI. ZP_BAD_INPUT names key, value, unit and range; also for a text key. */
ZP_API ZpStatus zp_value_parse(int index, const char *text, double *value, ZpError *err);

/* Write the templates of all pictures to `folder`, which is made if needed: to be edited there and named as the key
 * output.templates. ZP_BAD_INPUT if a file of that name is there already, ZP_MACHINE if one cannot be written. */
ZP_API ZpStatus zp_templates_write(const char *folder, ZpError *err);

/* Write a value of key `index` as a person would: "100 mm", "auto", "true", "plates". Reads back to the
 * same bits; of a text key, its default. `text` gets at most `size` bytes with the final 0. */
ZP_API void zp_value_print(int index, double value, char *text, size_t size);

/* Write a checkpoint to `file`. */
ZP_API ZpStatus zp_checkpoint_write(const ZpCheckpoint *checkpoint, FILE *file, ZpError *err);

/* Read one => *out, the caller's. ZP_BAD_INPUT says why: no such file, no checkpoint, cut short, damaged, of another
 * version. Whether it fits a model, zp_checkpoint_check says. */
ZP_API ZpStatus zp_checkpoint_read(const char *path, ZpCheckpoint **out, ZpError *err);

/* Name of the library (libfyaml, UDUNITS-2, HDF5) that this thread is in, NULL if none. These libraries crash, or call
 * exit, when an allocation fails. A program that defines malloc itself can end in order there. */
ZP_API const char *zp_library_at_work(void);

/* Leave out what HDF5 does when the process exits, which crashes where there is no memory. For programs that use HDF5
 * through this library only: it has closed all that it opened. To be called before any other use of HDF5. ZP_MACHINE if
 * there is no memory. */
ZP_API ZpStatus zp_hdf5_skip_exit(ZpError *err);

/* Processors that this process may use, 1 or more. */
ZP_API int zp_processors(void);

/* A folder for results that one run has for itself. */
typedef struct ZpFolder ZpFolder;

/* Make `directory` and its parents, make sure, before a long run, that results can be written there, and lock it until
 * zp_folder_close. What killed runs left half written is removed. ZP_MACHINE if it cannot be written, or if another run
 * holds it: then the message says which process. *out is NULL on failure. */
ZP_API ZpStatus zp_folder_open(const char *directory, ZpFolder **out, ZpError *err);

/* Unlock it; NULL is allowed. */
ZP_API void zp_folder_close(ZpFolder *folder);

/* Results that are read one by one: a campaign has more of them than memory. */
typedef struct ZpRows {
  const ZpResult *(*get)(void *user, size_t index); /* result `index`, valid until the next call; never NULL */
  ZpStatus (*status)(void *user, ZpError *err);     /* ZP_MACHINE if one of them could not be read */
  void *user;                                       /* handed to the functions above */
  /* Another reader of the same rows, for a thread of its own, to be closed by `close`. False if there can be none: then
   * files are written one after the other, as where this is NULL. */
  bool (*open)(void *user, struct ZpRows *own);
  void (*close)(void *user); /* of what `open` gave */
} ZpRows;

/* What an optimisation found among the cases of its report. */
typedef struct ZpOptimum {
  const size_t *row; /* [count] the best case; with several objectives those of the Pareto front, in the order of the
                      * first objective */
  size_t count;
  bool feasible;                /* they satisfy all constraints; else row[0] misses them least */
  double excluded;              /* share of the box in which no design does, as far as the cases tell; NAN: not asked */
  ZpOutcome outcome;            /* ZP_CONVERGED, ZP_INTERRUPTED */
  char message[256];            /* one sentence on what was found */
  const char *const *objective; /* [objectives] names of outputs */
  size_t objectives;
} ZpOptimum;

/* Where results go, and what was run. */
typedef struct ZpReport {
  const char *directory;      /* made if needed; result files in it are replaced, nothing else touched */
  const ZpScenario *scenario; /* what was run */
  ZpResult *const *result;    /* [count]; NULL where there are `rows` */
  size_t count;               /* zp_scenario_count, fewer if interrupted */
  double wall_time;           /* of all, s */
  const ZpFolder *folder;     /* `directory`, opened by the caller; NULL: zp_report_write opens and closes it */
  const ZpHooks *hooks;       /* asked while pictures are drawn: true ends that. NULL: nobody is asked */
  const ZpRows *rows;         /* in place of `result`; NULL: there is none */
  int jobs; /* files written and pictures drawn at once, 1 or more; 0: as many as there are processors */
  const ZpOptimum *optimum; /* of an optimisation; else NULL */
} ZpReport;

/* The largest number `scalar` of the rows whose number `where` is 1; NAN if there is none. */
ZP_API double zp_report_largest(const ZpReport *report, const char *scalar, const char *where);

/* Write summary.json (also what --json prints) to `file`. */
ZP_API ZpStatus zp_summary_write(const ZpReport *report, FILE *file, ZpError *err);

/* Write the same, of a report without rows, as one line. */
ZP_API ZpStatus zp_summary_write_line(const ZpReport *report, FILE *file, ZpError *err);

/* Write scenario.yaml, table.csv, results.h5, shapes.pvd with its .vtp files, of one run in time checkpoint.zps, then
 * summary.json, at last the pictures in plots/.
 * Each file appears under its name when it is complete. A picture that cannot be drawn is no failure: without gnuplot,
 * or where it fails or takes longer than a minute, the picture is left out, its .gp file stays, and `notice` (may be
 * NULL) says so. */
ZP_API ZpStatus zp_report_write(const ZpReport *report, void (*notice)(const char *message), ZpError *err);

#ifdef __cplusplus
}
#endif

#endif
