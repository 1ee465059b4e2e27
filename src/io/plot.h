/* What the pictures share: their table, the numbers that they look at, the look that they have. */
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

/* A picture: NAME.gp makes NAME.EXTENSION, from ../table.csv or from NAME.dat. */
typedef struct ZpPicture {
  const char *name, *extension;
  bool (*has)(const ZpPlot *plot);                /* whether there is something to draw */
  void (*script)(const ZpPlot *plot, FILE *file); /* writes the .gp */
  void (*data)(const ZpPlot *plot, FILE *file);   /* writes the .dat; NULL if there is none */
} ZpPicture;

/* Wall time after which gnuplot counts as hanging, s. The animation takes 2 s on an idle machine. */
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
extern const ZpPicture zp_member_pictures[];
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

/* A unit with an SI prefix in which a quantity has one to three digits before the point. */
typedef struct ZpPlotUnit {
  double factor; /* number in this unit = SI value * factor */
  char text[16]; /* "mm" */
} ZpPlotUnit;

/* (largest absolute value in SI, SI unit) => unit to show it in. */
ZpPlotUnit zp_plot_unit(double largest, const char *unit);

/* The same for the columns (ended by NULL) of a table together. */
ZpPlotUnit zp_plot_table_unit(const ZpTable *table, const char *const *column, const char *unit);

/* Whether the column has two values at least that can be drawn. */
bool zp_plot_has(const ZpTable *table, const char *column);

/* Box around all frames, m; of a run that diverged, around what is finite. */
typedef struct ZpPlotBox {
  double left, right, bottom, top;
} ZpPlotBox;

ZpPlotBox zp_plot_box(const ZpShapes *shapes);

/* Whether what is in the box can be seen where x and y have the same scale. */
bool zp_plot_fits_same_scale(const ZpPlotBox *box);

/* The unit for both axes. */
ZpPlotUnit zp_plot_box_unit(const ZpPlotBox *box);

/* The distance of tics, 1, 2 or 5 times a power of ten, of which at most `tics` fit into `range`; 0 of no range. */
double zp_plot_step(double range, int tics);

/* Give both axes the same scale and tics, about as many as `tics` on the longer one. */
void zp_plot_same_scale(FILE *file, const ZpPlotBox *box, ZpPlotUnit unit, int tics);

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

/* Write `text` as a gnuplot string that shows it as it is, in enhanced mode, too. */
void zp_plot_text(FILE *file, const char *text);

/* Settings that all SVG pictures share, with title and subtitle; the plot area is left of `right`
 * (0 .. 1) and the legend, at the top, right of it. */
void zp_plot_head(const ZpPlot *plot, FILE *file, const char *name, const char *title, double right);

/* Do the shapes show the left half only, the right half being its mirror image? */
bool zp_plot_is_half(const ZpPlot *plot);

/* As zp_plot_head, the title that of the shapes drawn: it says where they are of the left half only. */
void zp_plot_head_of_shapes(const ZpPlot *plot, FILE *file, const char *name, const char *title, double right);

/* Small print at the foot of a picture that shows how fast something zips. */
void zp_plot_foot(const ZpPlot *plot, FILE *file, const char *more);

/* Small print at the foot, on the left. */
void zp_plot_remark(FILE *file, const char *text);

/* Upper and lower of two panels. Title and small print belong to the whole and are drawn once. */
void zp_plot_upper_panel(FILE *file);
void zp_plot_lower_panel(FILE *file, double right, const char *xlabel);

/* The sentence of the small print. */
const char *zp_plot_drag_note(const ZpPlot *plot);

/* Colours that colour-blind people can tell apart (Okabe and Ito), "#0072b2". */
#define ZP_COLOURS 8
const char *zp_plot_colour(size_t index);

/* A place (0 .. 1) on a scale from dark to light: 0x440154. */
unsigned zp_plot_shade(double place);

/* Write one curve of ../table.csv over time; the `first` opens the plot command, which the caller ends
 * with a newline. `expression` is in gnuplot's words. */
void zp_plot_curve(FILE *file, bool first, ZpPlotUnit time, const char *expression, const char *title, size_t colour);

#endif
