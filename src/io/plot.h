/* What the pictures share: their table, the numbers that they look at, the look that they have. */
#ifndef ZP_IO_PLOT_H
#define ZP_IO_PLOT_H

#include <stdbool.h>
#include <stdio.h>

#include <zipact/io.h>

/* What there is to draw. */
typedef struct ZpPlot {
  const ZpReport *report;
  const ZpResult *single; /* the only run; NULL for a sweep */
  ZpActuatorDef def;      /* of the first run */
  ZpStudy study;
  char subtitle[320]; /* under what: load, voltage, N, preset */
} ZpPlot;

/* A picture: NAME.gp makes NAME.EXTENSION, from ../table.csv or from NAME.dat. */
typedef struct ZpPicture {
  const char *name, *extension;
  bool (*has)(const ZpPlot *plot);                /* whether there is something to draw */
  void (*script)(const ZpPlot *plot, FILE *file); /* writes the .gp */
  void (*data)(const ZpPlot *plot, FILE *file);   /* writes the .dat; NULL if there is none */
} ZpPicture;

/* All pictures that any report may have; the last has no name. */
extern const ZpPicture zp_series_pictures[];
extern const ZpPicture zp_shape_pictures[];
extern const ZpPicture zp_sweep_pictures[];

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

/* Write `text` as a gnuplot string that shows it as it is, in enhanced mode, too. */
void zp_plot_text(FILE *file, const char *text);

/* Settings that all SVG pictures share, with title and subtitle; the plot area is left of `right`
 * (0 .. 1) and the legend, at the top, right of it. */
void zp_plot_head(const ZpPlot *plot, FILE *file, const char *name, const char *title, double right);

/* Small print at the foot of a picture that shows how fast something zips. */
void zp_plot_foot(const ZpPlot *plot, FILE *file, const char *more);

/* The sentence of the small print. */
const char *zp_plot_drag_note(const ZpPlot *plot);

/* Colours that colour-blind people can tell apart (Okabe and Ito), "#0072b2". */
#define ZP_COLOURS 8
const char *zp_plot_colour(size_t index);

/* Write one curve of ../table.csv over time; the `first` opens the plot command, which the caller ends
 * with a newline. `expression` is in gnuplot's words. */
void zp_plot_curve(FILE *file, bool first, ZpPlotUnit time, const char *expression, const char *title, size_t colour);

#endif
