/* Constants of a model by name. */
#include <math.h>
#include <string.h>

#include "actuator/model.h"

double zp_model_get(const ZpModel *model, const char *name) {
  const ZpModelInfo info = zp_model_info(model);
  const struct {
    const char *name;
    double value;
  } number[] = {{"ribbons", info.ribbons},
                {"nodes", info.nodes},
                {"flexible_length", info.flexible_length},
                {"element_length", info.element_length},
                {"bending_stiffness", info.bending_stiffness},
                {"axial_stiffness", info.axial_stiffness},
                {"line_mass", info.line_mass},
                {"axial_spring", info.axial_spring},
                {"shear_coefficient", info.shear_coefficient},
                {"insulator_offset", info.insulator_offset},
                {"internal_damping", info.internal_damping},
                {"closed_line_force", info.closed_line_force},
                {"stable_time_step", info.stable_time_step}};
  for (size_t k = 0; k < sizeof number / sizeof number[0]; k++)
    if (strcmp(number[k].name, name) == 0) return number[k].value;
  return NAN;
}
