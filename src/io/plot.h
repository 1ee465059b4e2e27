/* What there is to draw of a report: its columns and shapes, as definitions and plain data for the templates. */
#ifndef ZP_IO_PLOT_H
#define ZP_IO_PLOT_H

#include <stdbool.h>
#include <stdio.h>

#include <zipact/io.h>

#include "io/report.h"
#include "io/shows.h"

/* A column of table.csv. */
typedef struct ZpPlotColumn {
  char name[ZP_KEY_COLUMN_SIZE];
  const char *unit; /* SI */
  int key;          /* the key that it lists; -1 if it is none */
  double low, high; /* range of its numbers; NAN if there are none */
  size_t count;     /* its numbers */
} ZpPlotColumn;

typedef struct ZpPlot {
  const ZpReport *report;
  const ZpResult *single; /* the only run; NULL for a sweep */
  ZpActuatorDef def;      /* of the first run */
  ZpStudy study;
  const ZpShapes *shapes; /* of the only run; NULL if there are none that can be drawn */
  ZpPlotColumn *column;   /* [columns] */
  size_t columns;
  const int *axis; /* [axes] keys whose lists are combined, the one that varies fastest last */
  size_t axes;
} ZpPlot;

/* (report) => what there is to draw, of a report with runs; to be closed, on failure too. */
ZpStatus zp_plot_open(const ZpReport *report, ZpPlot *plot, ZpError *err);
void zp_plot_close(ZpPlot *plot);

/* The column of this name; NULL if there is none. */
const ZpPlotColumn *zp_plot_column(const ZpPlot *plot, const char *name);

/* The shapes that are drawn: evenly in time, at most as many as an animation has frames => their number. */
enum { ZP_PLOT_FRAMES = 80 };
size_t zp_plot_frames(const ZpShapes *shapes, size_t frame[ZP_PLOT_FRAMES]);

/* Percent of the output per percent of the key; NAN if one of them is 0 or useless: a run that has closed ends where
 * openings and strokes pass 0. */
double zp_plot_percent(const ZpPlot *plot, const ZpSensitivity *s);

/* Write result.gp: all that a template may ask for. */
void zp_plot_define(const void *plot, FILE *file);

/* A file of plain columns in SI, and when there is one. */
typedef struct ZpPlotData {
  const char *name; /* "shapes.dat" */
  bool (*has)(const ZpPlot *plot);
  void (*put)(const void *plot, FILE *file);
} ZpPlotData;

extern const ZpPlotData zp_plot_data[]; /* the last has no name */

#endif
