#include "def/purpose.h"

#include "def/check.h"

/* Keys and groups of keys. */
typedef struct Part {
  size_t first, size;
  unsigned purposes;
} Part;

#define PART(field, purposes)                                                                                          \
  { offsetof(ZpKeyNumbers, field), sizeof(((ZpKeyNumbers *)0)->field), purposes }
static const Part parts[] = {PART(preset, ZP_NO_PARAMETER | ZP_MAY_CHANGE),
                             PART(drive, ZP_NO_PARAMETER | ZP_MAY_CHANGE),
                             PART(sense, ZP_NO_PARAMETER),
                             PART(control.kind, ZP_NO_PARAMETER),
                             PART(control.signal, ZP_NO_PARAMETER),
                             PART(control.proportional, ZP_MAY_CHANGE),
                             PART(control.integral, ZP_MAY_CHANGE),
                             PART(control.noise, ZP_MAY_CHANGE),
                             PART(control.seed, ZP_MAY_CHANGE),
                             PART(control.boost_voltage, ZP_MAY_CHANGE),
                             PART(control.boost_band, ZP_MAY_CHANGE),
                             PART(setpoint, ZP_NO_PARAMETER | ZP_MAY_CHANGE),
                             PART(solver.end_time, ZP_NO_PARAMETER | ZP_MAY_CHANGE),
                             PART(solver.tolerance, ZP_MAY_CHANGE),
                             PART(solver.time_step, ZP_MAY_CHANGE),
                             PART(solver.stop_when_zipped, ZP_NO_PARAMETER),
                             PART(solver.max_steps, ZP_MAY_CHANGE),
                             PART(solver.max_cpu_time, ZP_NO_PARAMETER | ZP_MAY_CHANGE | ZP_NO_RESULT),
                             PART(initial, ZP_NO_PARAMETER | ZP_MAY_CHANGE),
                             PART(base, ZP_NO_PARAMETER | ZP_MAY_CHANGE),
                             PART(data, ZP_NO_PARAMETER | ZP_MAY_CHANGE),
                             PART(calibrate, ZP_NO_PARAMETER | ZP_MAY_CHANGE),
                             PART(plan, ZP_NO_PARAMETER | ZP_MAY_CHANGE),
                             PART(modes, ZP_NO_PARAMETER | ZP_MAY_CHANGE),
                             PART(isometric, ZP_NO_PARAMETER | ZP_MAY_CHANGE),
                             PART(profile, ZP_NO_PARAMETER | ZP_MAY_CHANGE),
                             PART(cycle, ZP_NO_PARAMETER),
                             PART(sensitivity, ZP_NO_PARAMETER),
                             PART(sampling, ZP_NO_PARAMETER | ZP_MAY_CHANGE | ZP_NO_RESULT),
                             PART(optimize, ZP_NO_PARAMETER | ZP_MAY_CHANGE | ZP_NO_RESULT),
                             PART(output, ZP_NO_PARAMETER | ZP_MAY_CHANGE),
                             PART(output.plots, ZP_NO_RESULT),
                             PART(output.animation, ZP_NO_RESULT)};
#undef PART

unsigned zp_key_purposes(int index) {
  const size_t key = (size_t)index;
  unsigned purposes = 0;
  for (size_t k = 0; k < sizeof parts / sizeof parts[0]; k++)
    if (key >= parts[k].first && key - parts[k].first < parts[k].size) purposes |= parts[k].purposes;
  return purposes;
}
