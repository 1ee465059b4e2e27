/* The functions of the writers of result files, called by src/io/write_report.c only. */
#ifndef ZP_IO_WRITERS_H
#define ZP_IO_WRITERS_H

#include <zipact/io.h>

/* The writers. Each replaces its own files in report->directory and removes those of an earlier report that this one
 * does not have. */
ZpStatus zp_csv_write(const ZpReport *report, ZpError *err);
ZpStatus zp_hdf5_write(const ZpReport *report, ZpError *err);
ZpStatus zp_vtk_write(const ZpReport *report, ZpError *err);
ZpStatus zp_checkpoint_report(const ZpReport *report, ZpError *err);

/* Pictures: first the pictures of an earlier report are removed, and scripts and data of this one are written. When all
 * numbers are on the disk, gnuplot draws. A notice reports pictures that cannot be drawn. */
ZpStatus zp_plots_prepare(const ZpReport *report, ZpError *err);
void zp_plots_write(const ZpReport *report, void (*notice)(const char *message));

#endif
