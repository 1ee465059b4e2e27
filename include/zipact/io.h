/* Files: reads scenarios, writes results. The only part with units other than SI, file names and pictures. Needs
 * libfyaml, UDUNITS-2, jansson and HDF5, and gnuplot for pictures. */
#ifndef ZIPACT_IO_H
#define ZIPACT_IO_H

#include <stdio.h>

#include <zipact/api.h>
#include <zipact/study.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A scenario: values for keys, some of them lists or distributions. The combinations of its lists and the samples of
 * its distributions are a set of Defs. */
typedef struct ZpScenario ZpScenario;

/* A new scenario in which every key has its default. NULL if there is no memory. */
ZP_API ZpScenario *zp_scenario_create(void);
ZP_API void zp_scenario_destroy(ZpScenario *scenario);

/* Read a YAML file into `scenario`. ZP_BAD_INPUT names file, line, key, value, unit, range and the nearest known key,
 * also for a missing file; ZP_MACHINE if it cannot be read. On failure `scenario` is unchanged. */
ZP_API ZpStatus zp_scenario_read(ZpScenario *scenario, const char *path, ZpError *err);

/* Read a scenario from `size` bytes in memory; `name` replaces the file in messages. */
ZP_API ZpStatus zp_scenario_parse(ZpScenario *scenario, const char *text, size_t size, const char *name, ZpError *err);

/* As zp_scenario_parse, but its values override files and --set, until the next --set. */
ZP_API ZpStatus zp_scenario_override(ZpScenario *scenario, const char *text, size_t size, const char *name,
                                     ZpError *err);

/* Set a key by "KEY=VALUE", as --set does; it overrides the file. VALUE as in YAML, also a list "[1, 2]". */
ZP_API ZpStatus zp_scenario_set(ZpScenario *scenario, const char *assignment, ZpError *err);

/* Number of Defs of the scenario: the product of the lengths of its lists (1 without lists), lists of sampling.together
 * counted once, times the samples of its distributions. */
ZP_API size_t zp_scenario_count(const ZpScenario *scenario);

/* Keys that have lists or distributions, in key order; *count of them. Valid until the scenario changes. */
ZP_API const int *zp_scenario_lists(const ZpScenario *scenario, size_t *count);

/* The name of a key as a scenario writes it: "members.left.ribbon.thickness" where zp_key_name has
 * "member_1.ribbon.thickness". Written to `text`. */
enum { ZP_SCENARIO_KEY_SIZE = 128 };
ZP_API const char *zp_scenario_key(const ZpScenario *scenario, int key, char text[ZP_SCENARIO_KEY_SIZE]);

/* Was `key`, which has a unit, given as a number without a unit, other than 0? Then it was taken as SI, and *value is
 * the first such value, SI. */
ZP_API bool zp_scenario_bare_number(const ZpScenario *scenario, int key, double *value);

/* Do the results of a sweep keep their series: output.series? */
ZP_API bool zp_scenario_keeps_series(const ZpScenario *scenario);

/* The study of the scenario, the same for all its Defs. */
ZP_API ZpStudy zp_scenario_study(const ZpScenario *scenario);

/* Fill `def` by Def number `index`, resolved (zp_def_resolve) and checked (zp_study_check). Samples vary fastest, then
 * the last list key. */
ZP_API ZpStatus zp_scenario_def(const ZpScenario *scenario, size_t index, ZpActuatorDef *def, ZpError *err);

/* Write the scenario as YAML, with all keys resolved and lists as lists: it reads back to the same bits. */
ZP_API ZpStatus zp_scenario_write(const ZpScenario *scenario, FILE *file, ZpError *err);

/* Write the table of keys: for people, as JSON, as a starter scenario with help as comments, or as a JSON schema of
 * scenarios (draft 7), with which editors complete and check them. */
typedef enum ZpKeysFormat { ZP_KEYS_TEXT, ZP_KEYS_JSON, ZP_KEYS_YAML, ZP_KEYS_SCHEMA } ZpKeysFormat;
ZP_API ZpStatus zp_keys_write(ZpKeysFormat format, FILE *file, ZpError *err);

/* Read a value of key `index` in the form for people: "130 um", "auto", "true", "plates"; a number without a unit is
 * SI. ZP_BAD_INPUT names key, value, unit and range; also for a text key, and where there is no such key. */
ZP_API ZpStatus zp_value_parse(int index, const char *text, double *value, ZpError *err);

/* Set key `key` of a Def by a value in the form for people: "8 g", "auto", "true", "plates", or a text. ZP_BAD_INPUT as
 * zp_value_parse, or with the nearest known key; `def` is then unchanged. */
ZP_API ZpStatus zp_def_set_value(ZpActuatorDef *def, const char *key, const char *text, ZpError *err);

/* A result as bytes that mean the same on every machine, with all that is in it but the states of study limits. =>
 * their number; `bytes` NULL: they are only counted. */
ZP_API size_t zp_result_save(const ZpResult *result, void *bytes);

/* A result from `size` such bytes, which must outlive it: they hold its names => *result, which belongs to the caller.
 * ZP_BAD_INPUT, and NULL, names what is wrong: damaged, of another version; ZP_MACHINE if there is no memory. */
ZP_API ZpStatus zp_result_load(const void *bytes, size_t size, ZpResult **result, ZpError *err);

/* Write the templates of all pictures to `folder`, which is created if needed, for editing; ZpReport.templates names
 * the folder. ZP_BAD_INPUT if a file of that name exists already, ZP_MACHINE if one cannot be written. */
ZP_API ZpStatus zp_templates_write(const char *folder, ZpError *err);

/* Write a value of key `index` in the form for people: "100 mm", "auto", "true", "plates". It reads back to the same
 * bits; for a text key, its default; the number alone where there is no such key. `text` gets at most `size` bytes with
 * the final 0. */
ZP_API void zp_value_print(int index, double value, char *text, size_t size);

/* Write a checkpoint to `file`. */
ZP_API ZpStatus zp_checkpoint_write(const ZpCheckpoint *checkpoint, FILE *file, ZpError *err);

/* Read a checkpoint => *out, to be destroyed by the caller. ZP_BAD_INPUT gives the reason: no such file, not a
 * checkpoint, truncated, damaged, of another version. zp_checkpoint_check checks whether it fits a model. */
ZP_API ZpStatus zp_checkpoint_read(const char *path, ZpCheckpoint **out, ZpError *err);

/* Name of the library (libfyaml, UDUNITS-2, HDF5) in which this thread is, NULL if none. These libraries crash or call
 * exit if an allocation fails. A program that defines malloc can end in order there. */
ZP_API const char *zp_library_at_work(void);

/* Skip the clean-up of HDF5 at the exit of the process, which crashes without memory. For programs that use HDF5
 * through this library only, which closes all its objects. To be called before any other use of HDF5. ZP_MACHINE if
 * there is no memory. */
ZP_API ZpStatus zp_hdf5_skip_exit(ZpError *err);

/* Processors that this process may use, 1 or more. */
ZP_API int zp_processors(void);

/* A folder for results, locked by one run. */
typedef struct ZpFolder ZpFolder;

/* Create `directory` and its parents, check before a long run that results can be written there, and lock it until
 * zp_folder_close. Temporary files of killed runs are removed. ZP_MACHINE if it cannot be written, or if another run
 * holds it: then the message names the process. *out is NULL on failure. */
ZP_API ZpStatus zp_folder_open(const char *directory, ZpFolder **out, ZpError *err);

/* Unlock the folder; NULL is allowed. */
ZP_API void zp_folder_close(ZpFolder *folder);

/* Results that are read one by one: a campaign may have more of them than fit into memory. */
typedef struct ZpRows {
  const ZpResult *(*get)(void *user, size_t index); /* result `index`, valid until the next call; never NULL */
  ZpStatus (*status)(void *user, ZpError *err);     /* ZP_MACHINE if one of them could not be read */
  void *user;                                       /* argument of the functions above */
  /* Another reader of the same rows, for its own thread, to be closed by `close`. False, or NULL, if that is not
   * possible: then files are written one after the other. */
  bool (*open)(void *user, struct ZpRows *own);
  void (*close)(void *user); /* closes a reader of `open` */
} ZpRows;

/* The result of an optimisation among the cases of its report. */
typedef struct ZpOptimum {
  const size_t *row; /* [count] the best case; with several objectives those of the Pareto front, in the order of the
                      * first objective. Of a design with samples the first one */
  size_t count;
  bool feasible;     /* they satisfy all constraints; otherwise row[0] has the smallest violation */
  double excluded;   /* share of the box that contains no feasible design, according to the cases; NAN: not examined */
  ZpOutcome outcome; /* ZP_CONVERGED, ZP_INTERRUPTED */
  char message[256]; /* one sentence about the result */
  const char *const *objective; /* [objectives] names of outputs */
  size_t objectives;
  const char *const *constraint; /* [constraints] likewise */
  size_t constraints;
  const char *const *statistic; /* [objectives + constraints] of designs with samples: the number of the distribution
                                 * that counts, "quantile_05" */
  const double *value;          /* [count][objectives + constraints] SI; NAN: there is none */
  const int *variable;          /* [variables] the keys that were searched */
  size_t variables;
  size_t samples; /* cases of a design: 1 without distributions */
} ZpOptimum;

/* A report: its folder, its runs and their results. */
typedef struct ZpReport {
  const char *directory;      /* created if needed; result files in it are replaced, other files are unchanged */
  const ZpScenario *scenario; /* the scenario that was run */
  ZpResult *const *result;    /* [count]; NULL if there are `rows` */
  size_t count;               /* zp_scenario_count, fewer if interrupted */
  double wall_time;           /* of all runs, s */
  const ZpFolder *folder;     /* lock of `directory`, held by the caller; NULL: zp_report_write locks and unlocks it */
  const ZpHooks *hooks;       /* called while pictures are drawn: true stops drawing. May be NULL */
  const ZpRows *rows;         /* instead of `result`; NULL: none */
  int jobs; /* files written and pictures drawn at once, 1 or more; 0: as many as there are processors */
  const ZpOptimum *optimum; /* result of an optimisation; otherwise NULL */
  const char *templates;    /* folder of templates that replace the built-in ones of the same names; NULL: none. gnuplot
                             * runs them as programs: never take the folder from a scenario */
} ZpReport;

/* The largest number `scalar` of the rows whose number `where` is 1; NAN if there is none. */
ZP_API double zp_report_largest(const ZpReport *report, const char *scalar, const char *where);

/* Write summary.json (also what --json prints) to `file`. */
ZP_API ZpStatus zp_summary_write(const ZpReport *report, FILE *file, ZpError *err);

/* Write the same, of a report without rows, as one line. */
ZP_API ZpStatus zp_summary_write_line(const ZpReport *report, FILE *file, ZpError *err);

/* Write scenario.yaml, table.csv, results.h5, shapes.pvd with its .vtp files, for one run in time checkpoint.zps, then
 * summary.json, and finally the pictures in plots/. Each file appears under its name when it is complete. A picture
 * that cannot be drawn is not a failure: without gnuplot, or if gnuplot fails or takes longer than a minute, the
 * picture is missing, its .gp file stays, and `notice` (may be NULL) reports it. */
ZP_API ZpStatus zp_report_write(const ZpReport *report, void (*notice)(const char *message), ZpError *err);

#ifdef __cplusplus
}
#endif

#endif
