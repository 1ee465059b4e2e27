/* Times and voltages of drive.waveform table, or setpoints of setpoint.waveform table, from the scenario or a CSV file.
 */
#ifndef ZP_IO_DRIVE_TABLE_H
#define ZP_IO_DRIVE_TABLE_H

#include <zipact/def.h>
#include <zipact/drive.h>

/* Rows with their memory. */
typedef struct ZpDriveRows {
  size_t count;
  double *time, *voltage;
} ZpDriveRows;

/* Read drive.table or drive.file, with a controller setpoint.table or setpoint.file, and check the rows. To be freed
 * whatever the status is. ZP_BAD_INPUT names the row, or file, line and column, and the reason. */
ZpStatus zp_drive_rows_read(const ZpActuatorDef *def, ZpDriveRows *rows, ZpError *err);
void zp_drive_rows_free(ZpDriveRows *rows);

/* The rows in the form of the core. */
ZpDriveTable zp_drive_rows_table(const ZpDriveRows *rows);

#endif
