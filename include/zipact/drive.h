/* A voltage or a setpoint of the user's own over time, for drive.waveform or setpoint.waveform table. */
#ifndef ZIPACT_DRIVE_H
#define ZIPACT_DRIVE_H

#include <stddef.h>

#include <zipact/api.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Rows of times and voltages. Between two rows the voltage goes straight, before the first and after the last it is
 * theirs. Two rows at one time are a jump. */
typedef struct ZpDriveTable {
  size_t rows;           /* two or more */
  const double *time;    /* [rows] s, from 0 on; never falls */
  const double *voltage; /* [rows] V; of a setpoint in the unit of control.signal */
} ZpDriveTable;

/* What is wrong with a table, in half a sentence, and in which row (from 0); NULL if nothing is. */
ZP_API const char *zp_drive_table_fault(const ZpDriveTable *table, size_t *row);

#ifdef __cplusplus
}
#endif

#endif
