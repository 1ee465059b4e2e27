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

/* The key of the upper ribbon that a key of lower.* overrides; -1: it is none of these. A row of segments stands for
 * those of all. */
static int key_of_upper(int key) {
  const ZpInstance at = zp_key_instance(key);
  if (at.number > 0)
    return at.kind == ZP_OF_LOWER_SEGMENT
               ? zp_key_of_instance(zp_key_find(zp_key(key)->name + sizeof prefix - 1), at.number)
               : -1;
  return key >= lower_keys.first && key < lower_keys.end ? zp_key_find(zp_key(key)->name + sizeof prefix - 1) : -1;
}

const ZpActuatorDef *zp_def_lower(const ZpActuatorDef *def, ZpActuatorDef *room) {
  const ZpActuatorDef *lower = def;
  for (int key = lower_keys.first; key >= 0 && zp_key_instance(key).row < lower_keys.end;
       key = zp_def_next_key(def, key)) {
    if (!is_given(def, key)) continue;
    if (lower == def) *room = *def;
    lower = room;
    zp_def_set(room, key_of_upper(key), zp_def_get(def, key), NULL);
  }
  return lower;
}

int zp_def_key_of_ribbon(const ZpActuatorDef *def, int ribbon, int key) {
  char name[ZP_TEXT_SIZE];
  const int upper = key_of_upper(key);
  if (upper >= 0) return ribbon == 0 ? -1 : upper;
  snprintf(name, sizeof name, "%s%s", prefix, ZP_KEY_NAME(key));
  int own = ribbon == 0 ? -1 : zp_key_find(name);
  return own >= 0 && is_given(def, own) ? -1 : key;
}

double zp_insulator_thickness(const ZpActuatorDef *def) {
  return isnan(def->insulator.thickness) ? def->ribbon.thickness : def->insulator.thickness;
}

bool zp_def_creeps(const ZpActuatorDef *def) {
  return def->ribbon.relaxation_modulus > 0 || def->insulator.relaxation_modulus > 0;
}

double zp_insulation(const ZpActuatorDef *def) {
  double upper = zp_insulator_thickness(def), lower = def->lower.insulator.thickness;
  return upper + (isnan(lower) ? upper : lower);
}

int zp_def_segments(const ZpActuatorDef *ribbon) {
  int last = ZP_MOST_SEGMENTS;
  while (last > 0 && ribbon->segment_K[last - 1].length == 0)
    last--;
  return last;
}

static ZpStatus check_segments(const ZpActuatorDef *ribbon, const char *prefixed, double flexible, ZpError *err) {
  const int last = zp_def_segments(ribbon);
  double length = 0;
  for (int k = 0; k < last; k++)
    length += ribbon->segment_K[k].length;
  if (length > flexible * (1 + 1e-12))
    return zp_fail(
        err, ZP_BAD_INPUT,
        "%ssegment_1.length to %ssegment_%d.length: %g m together, more than the flexible length of the ribbon, %g m",
        prefixed, prefixed, last, length, flexible);
  const char *needs = ribbon->ribbon.plasticity               ? "ribbon.plasticity"
                      : ribbon->ribbon.relaxation_modulus > 0 ? "ribbon.relaxation_modulus"
                                                              : "insulator.relaxation_modulus";
  const bool even = ribbon->ribbon.plasticity || zp_def_creeps(ribbon);
  for (int k = 0; k < last && even; k++)
    if (ribbon->segment_K[k].length > 0 && ribbon->segment_K[k].thickness != ribbon->ribbon.thickness)
      return zp_fail(err, ZP_BAD_INPUT,
                     "%ssegment_%d.thickness = %g m: %s requires segments as thick as the ribbon, %g m", prefixed,
                     k + 1, ribbon->segment_K[k].thickness, needs, ribbon->ribbon.thickness);
  return ZP_OK;
}

/* An element may turn by nature by less than half a turn. */
static ZpStatus check_turns(const ZpActuatorDef *ribbon, const char *prefixed, double flexible, ZpError *err) {
  static const double most = 2; /* rad */
  const double U[] = {ribbon->drive.voltage, ribbon->drive.offset, ribbon->modes.voltage};
  const double element = flexible / (ribbon->mesh.nodes - 1);
  for (int k = 0; k < zp_def_segments(ribbon); k++)
    for (size_t i = 0; i < sizeof U / sizeof U[0]; i++) {
      const double a = ribbon->segment_K[k].curvature_per_volt, b = ribbon->segment_K[k].curvature_per_volt_squared,
                   driven = (a + b * U[i]) * U[i];
      if (ribbon->segment_K[k].length > 0 && fabs(driven) * element > most)
        return zp_fail(
            err, ZP_BAD_INPUT,
            "%ssegment_%d.curvature_per_volt%s: %g V would bend the segment to %g 1/m, an element by more than "
            "%g rad; give a lower voltage, less curvature per volt or more mesh.nodes",
            prefixed, k + 1, a == 0 ? "_squared" : "", U[i], driven, most);
    }
  return ZP_OK;
}

static bool is_driven(const ZpActuatorDef *ribbon, bool by_sign) {
  bool any = false;
  for (int k = 0; k < zp_def_segments(ribbon); k++) {
    const bool squared = !by_sign && ribbon->segment_K[k].curvature_per_volt_squared != 0;
    any |= ribbon->segment_K[k].length > 0 && (ribbon->segment_K[k].curvature_per_volt != 0 || squared);
  }
  return any;
}

/* Has the lower ribbon a segment that the upper one does not have? */
static bool has_own_segments(const ZpActuatorDef *def) {
  static const ZpKeyGroup rows = ZP_KEY_GROUP(lower.segment_K);
  return zp_segment_key_next(def, zp_key_of_instance(rows.first, 1) - 1) >= 0;
}

bool zp_def_drives(const ZpActuatorDef *def, bool by_sign) {
  if (is_driven(def, by_sign)) return true;
  if (!zp_def_has(def, ZP_DEVICE_PAIR) || !has_own_segments(def)) return false;
  ZpActuatorDef room;
  return is_driven(zp_def_lower(def, &room), by_sign);
}

ZpStatus zp_check_sign(const ZpActuatorDef *def, const char *key, double voltage, ZpError *err) {
  if (voltage >= 0 || zp_def_drives(def, true)) return ZP_OK;
  return zp_fail(err, ZP_BAD_INPUT,
                 "%s = %g V: must be at least 0 V, because nothing here depends on its sign; give "
                 "segment_1.curvature_per_volt and segment_1.length, or the voltage without its sign",
                 key, voltage);
}

/* Of a series or a network, each member is asked by itself. */
static ZpStatus check_signs(const ZpActuatorDef *def, ZpError *err) {
  static const int key[] = {ZP_KEY(drive.voltage), ZP_KEY(modes.voltage)};
  ZpStatus status = ZP_OK;
  const bool alone = !zp_def_network(def) && zp_def_members(def) == 1;
  for (size_t k = 0; k < sizeof key / sizeof key[0] && alone && status == ZP_OK; k++)
    status = zp_check_sign(def, zp_key(key[k])->name, zp_def_get(def, key[k]), err);
  return status;
}

/* A strip is clamped with a strain that springs back. */
static ZpStatus check_tension(const ZpActuatorDef *def, ZpError *err) {
  static const double most = 0.1;
  double stiffness = def->ribbon.width * (def->ribbon.thickness * def->ribbon.young_modulus +
                                          zp_insulator_thickness(def) * def->insulator.young_modulus);
  if (def->ribbon.tension <= most * stiffness) return ZP_OK;
  return zp_fail(err, ZP_BAD_INPUT, "ribbon.tension = %g N: at most %g N, which stretch the strip by %g %%",
                 def->ribbon.tension, most * stiffness, 100 * most);
}

ZpStatus zp_check_ribbons(const ZpActuatorDef *def, ZpError *err) {
  bool platform = zp_def_has(def, ZP_DEVICE_PLATFORM);
  double flexible = platform ? (def->ribbon.length - zp_platform_length(def)) / 2 : def->ribbon.length;
  ZpActuatorDef room;
  const ZpActuatorDef *lower = zp_def_lower(def, &room);
  ZpStatus status = check_signs(def, err);
  if (status == ZP_OK) status = check_tension(def, err);
  if (status == ZP_OK) status = check_segments(def, "", flexible, err);
  if (status == ZP_OK) status = check_segments(lower, prefix, flexible, err);
  if (status == ZP_OK) status = check_turns(def, "", flexible, err);
  return status == ZP_OK ? check_turns(lower, prefix, flexible, err) : status;
}

/* -- rules ----------------------------------------------------------------------------------------- */

#define ZP_SEGMENT(segment)                                                                                            \
  ZP_RULE(EQUATION, ZP_SET(segment.length), ZP_NOT(ribbon.plane, ZP_PLANE_ANTICLASTIC),                                \
          "the curl across a strip is modelled without segments, whose curl would change at a step"),                  \
      ZP_RULE(EQUATION, ZP_SET(segment.length), ZP_IS(ribbon.model, ZP_RIBBON_ROD),                                    \
              "the paper's springs and strips in space are straight and of one thickness")

static const ZpRule rule[] = {
    ZP_RULE(PHYSICS, ZP_SET_WITHIN(lower.ribbon.material, lower.segment_K.curvature_lag), ZP_HAS(PAIR),
            "the other kinds have no lower ribbon"),
    ZP_RULE(PHYSICS, ZP_SET_WITHIN(lower.insulator.material, lower.insulator.breakdown_field),
            ZP_CONDITION(actuator.kind, HAS, ZP_DEVICE_PAIR | ZP_DEVICE_SHAPED),
            "the other kinds have one ribbon, and one insulator or two equal ones"),
    ZP_RULE_IF(PHYSICS, ZP_SET(lower.insulator.density), ZP_IS(lower.insulator.material, ZP_INSULATOR_NONE),
               ZP_HAS(PAIR), "the mass of an electrode that stands still does not matter"),
    ZP_RULE(EQUATION, ZP_SET_WITHIN(lower.ribbon.material, lower.insulator.breakdown_field),
            ZP_IS(ribbon.model, ZP_RIBBON_ROD), "the paper's mechanics makes both ribbons equal"),
    ZP_SEGMENT(segment_K),
    ZP_SEGMENT(lower.segment_K),
};
#undef ZP_SEGMENT

static const ZpRules rules = ZP_RULES_OF(rule);
const ZpRules *const zp_rules_of_ribbons[] = {&rules, NULL};
