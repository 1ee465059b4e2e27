/* The lower of two ribbons: the values of the keys lower.*, and their conditions on other keys. */
#include <math.h>
#include <stddef.h>
#include <stdio.h>

#include "base/fail.h"
#include "def/device.h"

static const char prefix[] = "lower.";
static const ZpKeyGroup lower_keys = ZP_KEY_GROUP(lower);

/* Is this key of lower.* given? The word none of a material means that it is not. */
static bool is_given(const ZpActuatorDef *def, int key) {
  double value = zp_def_get(def, key);
  return zp_key(key)->type == ZP_KEY_ENUM ? value != 0 : !isnan(value);
}

ZpActuatorDef zp_def_lower(const ZpActuatorDef *def) {
  ZpActuatorDef lower = *def;
  for (int key = lower_keys.first; key < lower_keys.end; key++)
    if (is_given(def, key))
      zp_def_set(&lower, zp_key_find(zp_key(key)->name + sizeof prefix - 1), zp_def_get(def, key), NULL);
  return lower;
}

int zp_def_key_of_ribbon(const ZpActuatorDef *def, int ribbon, int key) {
  char name[ZP_TEXT_SIZE];
  bool is_lower = key >= lower_keys.first && key < lower_keys.end;
  if (is_lower) return ribbon == 0 ? -1 : zp_key_find(zp_key(key)->name + sizeof prefix - 1);
  snprintf(name, sizeof name, "%s%s", prefix, zp_key(key)->name);
  int own = ribbon == 0 ? -1 : zp_key_find(name);
  return own >= 0 && is_given(def, own) ? -1 : key;
}

double zp_insulation(const ZpActuatorDef *def) {
  double lower = def->lower.insulator.thickness;
  return def->insulator.thickness + (isnan(lower) ? def->insulator.thickness : lower);
}

bool zp_def_creeps(const ZpActuatorDef *def) {
  return def->ribbon.relaxation_modulus > 0 || def->insulator.relaxation_modulus > 0;
}

/* Has any segment a thickness that differs from that of the ribbon? */
static bool has_other_thickness(const ZpActuatorDef *ribbon) {
  double b = ribbon->ribbon.thickness;
  return (ribbon->segment_1.length > 0 && ribbon->segment_1.thickness != b) ||
         (ribbon->segment_2.length > 0 && ribbon->segment_2.thickness != b) ||
         (ribbon->segment_3.length > 0 && ribbon->segment_3.thickness != b);
}

static ZpStatus check_segments(const ZpActuatorDef *ribbon, const char *prefixed, double flexible, ZpError *err) {
  double segments = ribbon->segment_1.length + ribbon->segment_2.length + ribbon->segment_3.length;
  if (segments > flexible * (1 + 1e-12))
    return zp_fail(
        err, ZP_BAD_INPUT,
        "%ssegment_1.length to %ssegment_3.length: %g m together, more than the flexible length of the ribbon, %g m",
        prefixed, prefixed, segments, flexible);
  const char *needs = ribbon->ribbon.plasticity               ? "ribbon.plasticity"
                      : ribbon->ribbon.relaxation_modulus > 0 ? "ribbon.relaxation_modulus"
                                                              : "insulator.relaxation_modulus";
  if ((ribbon->ribbon.plasticity || zp_def_creeps(ribbon)) && has_other_thickness(ribbon))
    return zp_fail(err, ZP_BAD_INPUT,
                   "%ssegment_1.thickness to %ssegment_3.thickness: %s requires segments as thick as the ribbon, %g m",
                   prefixed, prefixed, needs, ribbon->ribbon.thickness);
  return ZP_OK;
}

/* A strip is clamped with a strain that springs back. */
static ZpStatus check_tension(const ZpActuatorDef *def, ZpError *err) {
  static const double most = 0.1;
  double stiffness = def->ribbon.width * (def->ribbon.thickness * def->ribbon.young_modulus +
                                          def->insulator.thickness * def->insulator.young_modulus);
  if (def->ribbon.tension <= most * stiffness) return ZP_OK;
  return zp_fail(err, ZP_BAD_INPUT, "ribbon.tension = %g N: at most %g N, which stretch the strip by %g %%",
                 def->ribbon.tension, most * stiffness, 100 * most);
}

ZpStatus zp_check_ribbons(const ZpActuatorDef *def, ZpError *err) {
  bool platform = zp_def_has(def, ZP_DEVICE_PLATFORM);
  double flexible = platform ? (def->ribbon.length - def->platform.length) / 2 : def->ribbon.length;
  ZpActuatorDef lower = zp_def_lower(def);
  ZpStatus status = check_tension(def, err);
  if (status == ZP_OK) status = check_segments(def, "", flexible, err);
  return status == ZP_OK ? check_segments(&lower, prefix, flexible, err) : status;
}

/* -- rules ----------------------------------------------------------------------------------------- */

#define ZP_SEGMENT(segment)                                                                                            \
  ZP_RULE(EQUATION, ZP_ABOVE(segment.length, 0), ZP_NOT(ribbon.plane, ZP_PLANE_ANTICLASTIC),                           \
          "the curl across a strip is modelled without segments, whose curl would change at a step"),                  \
      ZP_RULE(EQUATION, ZP_ABOVE(segment.length, 0), ZP_IS(ribbon.model, ZP_RIBBON_ROD),                               \
              "the paper's springs are those of a straight strip of one thickness")

static const ZpRule rule[] = {
    ZP_RULE(PHYSICS, ZP_SET_WITHIN(lower.ribbon.material, lower.insulator.permittivity), ZP_HAS(PAIR),
            "the other kinds have no lower ribbon"),
    ZP_RULE(EQUATION, ZP_SET_WITHIN(lower.ribbon.material, lower.insulator.permittivity),
            ZP_IS(ribbon.model, ZP_RIBBON_ROD), "the paper's mechanics makes both ribbons equal"),
    ZP_SEGMENT(segment_1),
    ZP_SEGMENT(segment_2),
    ZP_SEGMENT(segment_3),
    ZP_SEGMENT(lower.segment_1),
    ZP_SEGMENT(lower.segment_2),
    ZP_SEGMENT(lower.segment_3),
};
#undef ZP_SEGMENT

static const ZpRules rules = ZP_RULES_OF(rule);
const ZpRules *const zp_rules_of_ribbons[] = {&rules, NULL};
