#include "motion.h"

#include <math.h>
#include <time.h>

const double motion_swing_height = 6.05e-3;

static const double swing[][2] = {
#include "swing.def"
};

double motion_clock(void) {
  struct timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* -- cases ----------------------------------------------------------------------------------------- */

typedef struct Setting {
  const char *key;
  double value;
} Setting;

static ZpStatus resolve(const Setting *setting, size_t count, ZpActuatorDef *def, ZpError *err) {
  ZpAssignment list[16];
  for (size_t k = 0; k < count; k++)
    list[k] = (ZpAssignment){zp_key_find(setting[k].key), setting[k].value};
  return zp_def_resolve(def, list, count, err);
}

ZpStatus motion_swing(int nodes, bool implicit, ZpActuatorDef *def, ZpError *err) {
  const Setting setting[] = {{"actuator.kind", ZP_KIND_RIBBON},
                             {"actuator.right_end", ZP_END_FREE},
                             {"ribbon.length", 45e-3},
                             {"ribbon.thickness", 100e-6},
                             {"ribbon.plane", ZP_PLANE_STRESS},
                             {"load.mass", 2e-3},
                             {"initial.state", ZP_INITIAL_STRAIGHT},
                             {"damping.internal", 0},
                             {"mesh.nodes", nodes},
                             {"solver.integrator", implicit ? ZP_INTEGRATOR_IMPLICIT : ZP_INTEGRATOR_EXPLICIT},
                             {"solver.end_time", 0.1}};
  return resolve(setting, sizeof setting / sizeof setting[0], def, err);
}

Trajectory motion_swing_reference(void) {
  return (Trajectory){sizeof swing / sizeof swing[0], 1e-3, swing};
}

ZpStatus motion_zip(int nodes, bool implicit, ZpActuatorDef *def, ZpError *err) {
  const Setting setting[] = {{"mesh.nodes", nodes},
                             {"solver.integrator", implicit ? ZP_INTEGRATOR_IMPLICIT : ZP_INTEGRATOR_EXPLICIT},
                             {"solver.end_time", 70e-3}};
  return resolve(setting, sizeof setting / sizeof setting[0], def, err);
}

/* -- measuring ------------------------------------------------------------------------------------- */

/* Height at time t, interpolated between rows by the cubic that has their heights and velocities. */
static double height_at(const Trajectory *r, double t) {
  size_t i = (size_t)fmin(t / r->interval, (double)(r->rows - 2));
  double h = r->interval, x = t / h - (double)i;
  const double *a = r->row[i], *b = r->row[i + 1];
  return (1 + 2 * x) * (1 - x) * (1 - x) * a[0] + x * (1 - x) * (1 - x) * h * a[1] + x * x * (3 - 2 * x) * b[0] -
         x * x * (1 - x) * h * b[1];
}

static double load_height(const ZpShape *shape, const ZpShapes *film) {
  return shape->y[zp_shapes_ribbons(film) * zp_shapes_nodes(film) - 1];
}

/* Root mean square over the time of the recording. */
static double deviation(const ZpShapes *film, const Trajectory *reference) {
  double sum = 0, last = 0, before = 0, start = 0;
  for (size_t f = 0; f < zp_shapes_frames(film); f++) {
    ZpShape shape = zp_shapes_get(film, f);
    double off = load_height(&shape, film) - height_at(reference, shape.time);
    if (f > 0)
      sum += 0.5 * (shape.time - before) * (off * off + last * last);
    else
      start = shape.time;
    last = off;
    before = shape.time;
  }
  return sqrt(sum / (before - start));
}

/* One run; the cost of its steps => motion, if it is the lowest so far. */
static ZpStatus run(const ZpModel *model, ZpShapes *film, Motion *motion, ZpError *err) {
  double end = zp_def_number(zp_model_def(model), "solver.end_time");
  ZpSim *sim;
  ZpStatus status = zp_sim_create(model, NULL, &sim, err);
  if (status != ZP_OK) return status;
  zp_sim_record(sim, NULL, film);
  ZpRunInfo *info = zp_run_info_create();
  double start = motion_clock();
  ZpOutcome outcome = zp_sim_run(sim, end, false, NULL, info);
  motion->seconds = fmin(motion->seconds, (motion_clock() - start) / end);
  motion->steps = zp_run_info_get(info, "steps") / end;
  zp_run_info_destroy(info);
  zp_sim_destroy(sim);
  if (outcome == ZP_REACHED_END) return ZP_OK;
  *err = (ZpError){.status = ZP_MACHINE, .message = "a run of the benchmark failed"};
  return ZP_MACHINE;
}

static ZpStatus compare(const ZpModel *model, const Trajectory *reference, Motion *motion, ZpError *err) {
  enum { FRAMES = 4000 };
  ZpShapes *film =
      zp_shapes_create((size_t)zp_model_get(model, "ribbons"), (size_t)zp_model_get(model, "nodes"), FRAMES);
  if (!film) {
    *err = (ZpError){ZP_MACHINE, "no memory"};
    return ZP_MACHINE;
  }
  ZpStatus status = run(model, film, motion, err);
  if (status == ZP_OK) motion->rms = deviation(film, reference);
  zp_shapes_destroy(film);
  return status;
}

ZpStatus motion_measure(const ZpActuatorDef *def, const ZpDriveTable *table, const Trajectory *reference,
                        Motion *motion, ZpError *err) {
  static const double enough = 0.3; /* s */
  enum { TRIES = 20 };
  ZpModel *model;
  double start = motion_clock();
  *motion = (Motion){INFINITY, NAN, NAN, NAN};
  ZpStatus status = zp_model_create_driven(def, table, &model, err);
  if (status != ZP_OK) return status;
  status = reference ? compare(model, reference, motion, err) : run(model, NULL, motion, err);
  for (int k = 1; k < TRIES && status == ZP_OK && motion_clock() - start < enough; k++)
    status = run(model, NULL, motion, err);
  zp_model_destroy(model);
  motion->cpu = motion_clock() - start;
  return status;
}

/* Place of the load in a shape: the last node of the lower ribbon. */
static size_t last_node(const ZpModel *model) {
  return (size_t)(zp_model_get(model, "ribbons") * zp_model_get(model, "nodes")) - 1;
}

ZpStatus motion_record(const ZpActuatorDef *def, size_t rows, double interval, double (*row)[2], ZpError *err) {
  ZpModel *model;
  ZpSim *sim = NULL;
  ZpStatus status = zp_model_create(def, &model, err);
  if (status == ZP_OK) status = zp_sim_create(model, NULL, &sim, err);
  const size_t last = status == ZP_OK ? last_node(model) : 0;
  for (size_t i = 0; i < rows && status == ZP_OK; i++) {
    zp_sim_run(sim, (double)i * interval, false, NULL, NULL);
    row[i][0] = zp_sim_shape(sim).y[last];
    row[i][1] = zp_sim_get(sim, "end_velocity");
  }
  zp_sim_destroy(sim);
  zp_model_destroy(model);
  return status;
}
