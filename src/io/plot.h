/* What the pictures share: their table, the numbers that they look at, what they define for their templates. */
#ifndef ZP_IO_PLOT_H
#define ZP_IO_PLOT_H

#include <stdbool.h>
#include <stdio.h>

#include <zipact/io.h>

#include "io/shows.h"

/* What there is to draw. */
typedef struct ZpPlot {
  const ZpReport *report;
  const ZpResult *single; /* the only run; NULL for a sweep */
  ZpActuatorDef def;      /* of the first run */
  bool drawn;             /* output.plots, and not too many runs */
  ZpStudy study;
  ZpShows shows;             /* what its results are */
  char subtitle[320];        /* under what: load, voltage, N, preset */
  const struct ZpRuns *runs; /* what pictures of several reports look at; else NULL */
} ZpPlot;

/* A picture: NAME.gp makes NAME.EXTENSION, from ../table.csv or from NAME.dat. The script is what `define` writes, then
 * the template, which says all that is look and layout. */
typedef struct ZpPicture {
  const char *name, *extension;
  bool (*has)(const ZpPlot *plot);                /* whether there is something to draw */
  void (*define)(const ZpPlot *plot, FILE *file); /* writes the variables that the template reads */
  void (*data)(const ZpPlot *plot, FILE *file);   /* writes the .dat; NULL if there is none */
  const char *template;                           /* "stroke.gp"; NULL: what `define` writes is all */
} ZpPicture;

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

/* All pictures that any report may have; the last has no name. */
extern const ZpPicture zp_series_pictures[];
extern const ZpPicture zp_shape_pictures[];
extern const ZpPicture zp_liquid_pictures[];
extern const ZpPicture zp_sweep_pictures[];
extern const ZpPicture zp_map_pictures[];
extern const ZpPicture zp_path_pictures[];
extern const ZpPicture zp_rest_pictures[];
extern const ZpPicture zp_fit_pictures[];
extern const ZpPicture zp_field_pictures[];
extern const ZpPicture zp_sensitivity_pictures[];
extern const ZpPicture zp_sample_pictures[];
extern const ZpPicture zp_many_pictures[];

/* Box around all frames, m; of a run that diverged, around what is finite. */
typedef struct ZpPlotBox {
  double left, right, bottom, top;
} ZpPlotBox;

/* Define a variable of a script: a number in SI, NaN where there is none; a whole number; a text, shown as it is; a
 * word of the program, to be compared and not to be shown. */
void zp_plot_define(FILE *file, const char *name, double value);
void zp_plot_define_count(FILE *file, const char *name, size_t value);
void zp_plot_define_text(FILE *file, const char *name, const char *text);
void zp_plot_define_word(FILE *file, const char *name, const char *word);

/* Define the key "drive.voltage" of the first run as drive_voltage, in SI or as its word. */
void zp_plot_define_key(const ZpPlot *plot, FILE *file, const char *key);

/* Define a number of the summary of the only run under its own name. */
void zp_plot_define_scalar(const ZpPlot *plot, FILE *file, const char *name);

/* Define what plots/functions.gp asks about a table: columns, and of each the largest absolute value, the lowest and
 * the highest one. */
void zp_plot_define_table(FILE *file, const ZpTable *table);

/* Define box_left, box_right, box_bottom and box_top, m; and `same_scale`: whether x and y may have one. */
void zp_plot_define_box(FILE *file, const ZpPlotBox *box);

/* Define an array of `count` (1 or more) entries, which zp_plot_define_count and the like then fill as NAME[1], ... */
void zp_plot_define_array(FILE *file, const char *name, size_t count);

/* "NAME[k]", k from 1, for these. */
typedef struct ZpPlotEntry {
  char text[48];
} ZpPlotEntry;
ZpPlotEntry zp_plot_entry(const char *name, size_t k);

/* Whether the column has two values at least that can be drawn. */
bool zp_plot_has(const ZpTable *table, const char *name);

ZpPlotBox zp_plot_box(const ZpShapes *shapes);

/* Is this the last node of a ribbon of a member of a series? */
static inline bool zp_plot_ends_member(const ZpShapes *shapes, size_t node) {
  return (node + 1) % (shapes->nodes / shapes->members) == 0;
}

/* Write a frame: lines of x and y, then of `more`. A row of NaN ends a ribbon, not an empty one: for that
 * gnuplot 5.4 uses a colour that it never set, and its picture is not the same each time. */
void zp_plot_put_shape(FILE *file, const ZpShapes *shapes, const ZpShape *shape, double more);

/* Is it a run of two ribbons with liquid, or with a bead, between them? */
bool zp_plot_has_liquid(const ZpPlot *plot);
bool zp_plot_has_bead(const ZpPlot *plot);

/* How a half is drawn: x counts from `middle` (m), times `sign`; of the whole actuator, from its right end on. */
typedef struct ZpPlotSide {
  double middle, sign;
  bool from_right;
} ZpPlotSide;

/* Write lines of x and both y where there is liquid between the ribbons of one half, from its clip on. */
void zp_plot_put_liquid(const ZpPlot *plot, FILE *file, const ZpShape *shape, const ZpPlotSide *side);

/* Frame nearest to a part (0 .. 1) of the time from the first frame to the last. */
size_t zp_plot_frame_at(const ZpShapes *shapes, double part);

/* Value of a column at the row nearest to a time; NAN if there is none. */
double zp_plot_at_time(const ZpTable *table, const char *column, double time);

/* Write a number of a .dat file so that it reads back the same. */
void zp_plot_put(FILE *file, double value, char after);

/* Do the shapes show the left half only, the right half being its mirror image? */
bool zp_plot_is_half(const ZpPlot *plot);

/* The sentence of the small print. */
const char *zp_plot_drag_note(const ZpPlot *plot);

#endif
