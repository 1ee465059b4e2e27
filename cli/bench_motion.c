/* Cost of a motion, and its distance from a converged one. */
#include <math.h>

#include "bench.h"
#include "motion.h"

static Row row_of(const char *name, const ZpActuatorDef *def, const Motion *motion, double scale) {
  int ribbons = def->actuator.kind == ZP_KIND_ELECTRO_RIBBON ? 2 : 1;
  return (Row){.name = name,
               .nodes = def->mesh.nodes,
               .ns_per_node_step = 1e9 * motion->seconds / (motion->steps * ribbons * def->mesh.nodes),
               .steps = motion->steps,
               .seconds = motion->seconds,
               .cpu = motion->cpu,
               .paper_ratio = NAN,
               .error = motion->rms / scale};
}

/* Error: rms of the distance of the tip from the converged swing, over the height of the swing. */
static ZpStatus swing(const char *name, int nodes, bool implicit, Row *row, ZpError *err) {
  Trajectory reference = motion_swing_reference();
  ZpActuatorDef def;
  Motion motion;
  ZpStatus status = motion_swing(nodes, implicit, &def, err);
  if (status == ZP_OK) status = motion_measure(&def, NULL, &reference, &motion, err);
  if (status == ZP_OK) *row = row_of(name, &def, &motion, motion_swing_height);
  return status;
}

ZpStatus bench_swing(int nodes, Row *row, ZpError *err) {
  return swing("swing of a cantilever", nodes, true, row, err);
}

ZpStatus bench_swing_explicit(int nodes, Row *row, ZpError *err) {
  return swing("explicit swing", nodes, false, row, err);
}

ZpStatus bench_zip(int nodes, Row *row, ZpError *err) {
  ZpActuatorDef def;
  Motion motion;
  ZpStatus status = motion_zip(nodes, true, &def, err);
  def.solver.end_time = 90e-3; /* until it has closed */
  if (status == ZP_OK) status = motion_measure(&def, NULL, NULL, &motion, err);
  if (status == ZP_OK) *row = row_of("zip, default actuator", &def, &motion, NAN);
  return status;
}

/* The actuator zips, is held, is released and swings, 1 s in total. */
ZpStatus bench_use(int nodes, Row *row, ZpError *err) {
  static const double time[] = {0, 0.48, 0.48}, voltage[] = {10e3, 10e3, 0};
  static const ZpDriveTable table = {3, time, voltage};
  ZpActuatorDef def;
  Motion motion;
  ZpStatus status = motion_zip(nodes, true, &def, err);
  def.drive.waveform = ZP_WAVEFORM_TABLE;
  def.solver.end_time = 1;
  if (status == ZP_OK) status = motion_measure(&def, &table, NULL, &motion, err);
  if (status == ZP_OK) *row = row_of("zip, hold, release, swing", &def, &motion, NAN);
  return status;
}
