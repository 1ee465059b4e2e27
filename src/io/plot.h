/* What the pictures share: their table, the numbers that they look at, what is defined for their templates. */
#ifndef ZP_IO_PLOT_H
#define ZP_IO_PLOT_H

#include <stdbool.h>
#include <stdio.h>

#include <zipact/io.h>

#include "io/report.h"
#include "io/shows.h"

/* What a study answers with one or two numbers of the summary, drawn against keys: a row of studies.def. */
typedef struct ZpAnswer {
  ZpStudy study;
  const char *picture, *title, *axis, *unit; /* no unit: a pure number */
  const char *scalar[2], *legend[2];         /* the second may be NULL */
  const char *count;                         /* how many points there are, after "3 of 5 runs " */
} ZpAnswer;

/* What there is to draw. */
typedef struct ZpPlot {
  const ZpReport *report;
  const ZpResult *single;    /* the only run; NULL for a sweep */
  const ZpTable *table;      /* what ../table.csv has, words as their numbers; NULL if it has nothing */
  ZpActuatorDef def;         /* of the first run */
  ZpShows shows;             /* what its results are */
  const ZpAnswer *answer;    /* of a study that has one; else NULL */
  char subtitle[320];        /* under what: load, voltage, N, preset */
  const struct ZpRuns *runs; /* what pictures of several reports look at; else NULL */
  bool drawn;                /* output.plots, and not too many runs */
  ZpTable *sweep;            /* `table` of a sweep, and the names of its keys */
  char (*key_column)[ZP_KEY_COLUMN_SIZE];
} ZpPlot;

/* (report) => what there is to draw, of a report without runs nothing; to be closed, on failure too. */
ZpStatus zp_plot_open(const ZpReport *report, ZpPlot *plot, ZpError *err);
void zp_plot_close(ZpPlot *plot);

/* 1 << ZP_SHOWS_... of results. */
#define ZP_OF(shows) (1u << ZP_SHOWS_##shows)
#define ZP_OF_ANY    (~0u)

/* A picture: NAME.gp makes NAME.EXTENSION, from ../table.csv or from NAME.dat. The script is definitions, then the
 * template, which says all that is look and layout. What every picture may need is defined for all
 * (zp_plot_define_common). There is something to draw where all that is said here holds. */
typedef struct ZpPicture {
  const char *name, *extension;
  const char *template;            /* "stroke.gp"; NULL: what `define` writes is all */
  unsigned one, many;              /* ZP_OF results of one run, of several; both 0: any */
  const char *needs;               /* columns of the table with two numbers at least, between spaces; NULL: none */
  const char *keys;                /* one of these differs from its default; NULL: none has to */
  bool (*has)(const ZpPlot *plot); /* what else has to be; NULL: nothing */
  void (*define)(const ZpPlot *plot, FILE *file); /* defines more; NULL: nothing */
  void (*data)(const ZpPlot *plot, FILE *file);   /* writes the .dat; NULL: there is none */
} ZpPicture;

bool zp_picture_is_drawn(const ZpPicture *picture, const ZpPlot *plot);

/* All pictures that any report may have; the last has no name. */
extern const ZpPicture zp_run_pictures[];
extern const ZpPicture zp_shape_pictures[];
extern const ZpPicture zp_film_pictures[];
extern const ZpPicture zp_sweep_pictures[];
extern const ZpPicture zp_map_pictures[];
extern const ZpPicture zp_path_pictures[];
extern const ZpPicture zp_fit_pictures[];
extern const ZpPicture zp_field_pictures[];
extern const ZpPicture zp_sensitivity_pictures[];
extern const ZpPicture zp_sample_pictures[];
extern const ZpPicture zp_many_pictures[];

/* Wall time after which gnuplot counts as hanging, s. The animation takes 4 s on an idle machine. */
#define ZP_PLOT_PATIENCE 60.0

/* Where pictures go. */
typedef struct ZpDrawing {
  const ZpPlot *plot;
  const char *folder;                  /* made if needed */
  void (*notice)(const char *message); /* NULL: silent */
  double patience;                     /* ZP_PLOT_PATIENCE, s */
  const ZpHooks *hooks;                /* asked while gnuplot runs: true ends it. May be NULL */
  int jobs;                            /* pictures drawn at once; 0: as many as there are processors */
  bool over;                           /* no more pictures: there is no gnuplot, it hangs, or a hook said so */
} ZpDrawing;

/* Remove the pictures of `tables` and write scripts and data of those that there is something to draw for. */
ZpStatus zp_drawing_prepare(const ZpDrawing *drawing, const ZpPicture *const *table, size_t tables, ZpError *err);

/* Let gnuplot draw them. A picture that it cannot draw is no failure: its script stays and the notice says why. */
void zp_drawing_draw(ZpDrawing *drawing, const ZpPicture *const *table, size_t tables);

/* -- definitions ----------------------------------------------------------------------------------- */

/* Define a variable of a script: a number in SI, NaN where there is none; a whole number; a text, shown as it is; a
 * word of the program, to be compared and not to be shown. */
void zp_plot_define(FILE *file, const char *name, double value);
void zp_plot_define_count(FILE *file, const char *name, size_t value);
void zp_plot_define_text(FILE *file, const char *name, const char *text);
void zp_plot_define_word(FILE *file, const char *name, const char *word);

/* Print the value of a key for people: "6.667 kV", "50 µm". */
void zp_plot_print_value(int key, double value, char *text, size_t size);

/* Define an array of `count` (1 or more) entries, which zp_plot_define_count and the like then fill as NAME[1], ... */
void zp_plot_define_array(FILE *file, const char *name, size_t count);

/* "NAME[k]", k from 1, for these; "NAME" of k = 0. */
typedef struct ZpPlotEntry {
  char text[64];
} ZpPlotEntry;
ZpPlotEntry zp_plot_entry(const char *name, size_t k);

/* Define what every template may ask for: subtitle and note; of the table its columns and their ranges; of shapes how
 * they are and the box around them; of a sweep its axes, its curves and its answer; and those keys, as drive_voltage,
 * in SI or as words, and numbers of the summary that `text`, the template, mentions. */
void zp_plot_define_common(const ZpPlot *plot, const char *text, FILE *file);

/* Define NAME_name, NAME_unit and NAME_factor of a key, or with `k` from 1 their entries k: what an axis is called and
 * what a number in SI is to be multiplied with. */
void zp_plot_define_key_axis(FILE *file, const char *name, size_t k, int key);

/* Write a number of a .dat file so that it reads back the same. */
void zp_plot_put(FILE *file, double value, char after);

/* -- tables ---------------------------------------------------------------------------------------- */

/* Number of a column; as many as there are columns if none has this name. */
size_t zp_plot_column(const ZpTable *table, const char *name);

/* How many values of the column can be drawn; whether two can. */
size_t zp_plot_count(const ZpTable *table, const char *name);
bool zp_plot_has(const ZpTable *table, const char *name);

/* Range of a column; NAN of one without numbers. */
typedef struct ZpPlotRange {
  double low, high;
} ZpPlotRange;
ZpPlotRange zp_plot_range(const ZpTable *table, const char *name);

/* Value of a column at the row nearest to a time; NAN if there is none. */
double zp_plot_at_time(const ZpTable *table, const char *column, double time);

/* -- shapes ---------------------------------------------------------------------------------------- */

/* Box around all frames, m; of a run that diverged, around what is finite. */
typedef struct ZpPlotBox {
  double left, right, bottom, top;
} ZpPlotBox;
ZpPlotBox zp_plot_box(const ZpShapes *shapes);

/* Define box_left, box_right, box_bottom and box_top, m; and `same_scale`: whether x and y may have one. */
void zp_plot_define_box(FILE *file, const ZpPlotBox *box);

/* Has the only run shapes, `frames` at least, that can be drawn? */
bool zp_plot_has_frames(const ZpPlot *plot, size_t frames);

/* Do the shapes show the left half only, the right half being its mirror image? */
bool zp_plot_is_half(const ZpPlot *plot);

/* Frame nearest to a part (0 .. 1) of the time from the first frame to the last. */
size_t zp_plot_frame_at(const ZpShapes *shapes, double part);

/* Curves of profiles.svg and film.svg, as many as can be told apart: evenly in time
 * => how many there are. */
enum { ZP_PLOT_SNAPSHOTS = 8 };
size_t zp_plot_snapshots(const ZpShapes *shapes, size_t frame[ZP_PLOT_SNAPSHOTS]);

/* -- sweeps ---------------------------------------------------------------------------------------- */

/* The list key that varies fastest (back = 0), next to fastest (1), ...; -1 if there is none. */
int zp_sweep_key(const ZpPlot *plot, size_t back);

/* Value of a list key in a run, SI; NAN for auto. */
double zp_sweep_value(const ZpPlot *plot, size_t run, int key);

/* Are there runs to draw against the list key that varies fastest: no samples, no optimisation? */
bool zp_sweep_has_axis(const ZpPlot *plot);

/* The values of the list keys of a run, "8 kV, 21": but of the last `without` of them, and of those that are drawn from
 * distributions. */
void zp_sweep_run_name(const ZpPlot *plot, size_t run, size_t without, char *text, size_t size);

/* Define the axes, the curves and the answer of a sweep. */
void zp_sweep_define(const ZpPlot *plot, FILE *file);

#endif
