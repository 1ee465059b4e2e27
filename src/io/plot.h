/* Definitions and plain columns from which the templates draw the pictures of a report. */
#ifndef ZP_IO_PLOT_H
#define ZP_IO_PLOT_H

#include <stdbool.h>
#include <stdio.h>

#include <zipact/io.h>

#include "def/def.h"
#include "io/report.h"

/* A column of table.csv. */
typedef struct ZpPlotColumn {
  char name[ZP_KEY_COLUMN_SIZE];
  const char *unit; /* SI */
  const char *help; /* of a series: what it is */
  int key;          /* the key that it lists; -1 if it is none */
  double low, high; /* range of its numbers; NAN if there are none */
  size_t count;     /* its numbers */
} ZpPlotColumn;

typedef struct ZpPlot {
  const ZpReport *report;
  const ZpResult *single; /* the only run; NULL for a sweep */
  ZpActuatorDef def;      /* of the first run */
  ZpStudy study;
  ZpPlotColumn *column; /* [columns] */
  size_t columns;
  const int *axis; /* [axes] keys whose lists are combined, the one that varies fastest last */
  size_t axes;
} ZpPlot;

/* (report with runs, plot->def) => what there is to draw. The columns are to be freed, on failure too. */
ZpStatus zp_plot_open(const ZpReport *report, ZpPlot *plot, ZpError *err);

/* The column of this name; NULL if there is none. */
const ZpPlotColumn *zp_plot_column(const ZpPlot *plot, const char *name);

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
