/* A voltage or a setpoint of the user's own over time, for drive.waveform or setpoint.waveform table. */
#ifndef ZIPACT_DRIVE_H
#define ZIPACT_DRIVE_H

#include <stddef.h>

#include <zipact/api.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Rows of times and voltages. The voltage is linear between two rows, and constant before the first and after the last.
 * Two rows at the same time are a jump. */
typedef struct ZpDriveTable {
  size_t rows;           /* two or more */
  const double *time;    /* [rows] s, 0 or more; must not decrease */
  const double *voltage; /* [rows] V; for a setpoint in the unit of control.signal */
} ZpDriveTable;

/* The fault of a table, as half a sentence, and its row (from 0); NULL if there is none. */
ZP_API const char *zp_drive_table_fault(const ZpDriveTable *table, size_t *row);

#ifdef __cplusplus
}
#endif

#endif
