/* Constants of a model by name; in series those of its uppermost member. */
#include <math.h>
#include <string.h>

#include "actuator/model.h"

double zp_model_get(const ZpModel *model, const char *name) {
  const ZpSection section = zp_ribbon_section(model, 0);
  const struct {
    const char *name;
    double value;
  } number[] = {
      {"ribbons", (double)model->s},
      {"nodes", (double)model->nodes},
      {"flexible_length", model->L},
      {"element_length", model->l},
      {"bending_stiffness", section.EI},
      {"axial_stiffness", section.EA},
      {"line_mass", section.mu},
      {"axial_spring", model->spring.K_D},
      {"shear_coefficient", model->spring.K_S},
      {"insulator_offset", model->plates.d},
      {"internal_damping", model->internal_damping},
      {"closed_line_force", zp_plates_law(&model->plates, zp_waveform_largest(&model->waveform), 0).W},
      {"stable_time_step", model->stable_step},
  };
  for (size_t k = 0; k < sizeof number / sizeof number[0]; k++)
    if (strcmp(number[k].name, name) == 0) return number[k].value;
  return NAN;
}
