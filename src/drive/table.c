/* Is a table of a voltage over time, which comes from outside, possible? */
#include <zipact/drive.h>

#include <math.h>

const char *zp_drive_table_fault(const ZpDriveTable *table, size_t *row) {
  static const double latest = 1e4, largest = 1e6; /* s, V: as solver.end_time and drive.voltage */
  const double *t = table->time;
  *row = 0;
  if (table->rows < 1) return "a table needs at least one row";
  for (size_t i = 0; i < table->rows; i++) {
    *row = i;
    if (!(t[i] >= 0 && t[i] <= latest)) return "the time is out of range; 0 s to 10000 s";
    if (!(fabs(table->voltage[i]) <= largest)) return "the voltage is out of range; -1000 kV to 1000 kV";
    if (i > 0 && t[i] < t[i - 1]) return "the time is earlier than in the row above; times must be in order";
    if (i > 1 && t[i] == t[i - 2]) return "three rows have the same time; two make a jump";
  }
  return NULL;
}
