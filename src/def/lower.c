/* The lower of two ribbons: the values of the keys lower.*, and their conditions on other keys. */
#include <math.h>
#include <stddef.h>

#include "base/fail.h"
#include "def/check.h"

static const char prefix[] = "lower.";
static const ZpKeyGroup lower_keys = ZP_KEY_GROUP(lower);

/* Is this key of lower.* given? The word none of a material means that it is not. */
static bool is_given(const ZpActuatorDef *def, int key) {
  double value = zp_def_get(def, key);
  return zp_key(key)->type == ZP_KEY_ENUM ? value != 0 : !isnan(value);
}

bool zp_def_has_two(const ZpActuatorDef *def) {
  return def->actuator.kind == ZP_KIND_ELECTRO_RIBBON || def->actuator.kind == ZP_KIND_HINGE;
}

ZpActuatorDef zp_def_lower(const ZpActuatorDef *def) {
  ZpActuatorDef lower = *def;
  for (int key = lower_keys.first; key < lower_keys.end; key++)
    if (is_given(def, key))
      zp_def_set(&lower, zp_key_find(zp_key(key)->name + sizeof prefix - 1), zp_def_get(def, key), NULL);
  return lower;
}

double zp_insulation(const ZpActuatorDef *def) {
  double lower = def->lower.insulator.thickness;
  return def->insulator.thickness + (isnan(lower) ? def->insulator.thickness : lower);
}

static ZpStatus check_not_given(const ZpActuatorDef *def, const char *key, const char *asks, ZpError *err) {
  if (isnan(zp_def_get(def, zp_key_find(key)))) return ZP_OK;
  return zp_fail(err, ZP_BAD_INPUT, "%s: requires %s auto, that is, the value of the upper ribbon", asks, key);
}

ZpStatus zp_check_like_insulators(const ZpActuatorDef *def, const char *asks, ZpError *err) {
  ZpStatus status = check_not_given(def, "lower.insulator.thickness", asks, err);
  return status == ZP_OK ? check_not_given(def, "lower.insulator.permittivity", asks, err) : status;
}

ZpStatus zp_check_like_sections(const ZpActuatorDef *def, const char *asks, ZpError *err) {
  ZpStatus status = zp_check_like_insulators(def, asks, err);
  return status == ZP_OK ? check_not_given(def, "lower.ribbon.thickness", asks, err) : status;
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
  if (segments > 0 && ribbon->ribbon.plane == ZP_PLANE_ANTICLASTIC)
    return zp_fail(err, ZP_BAD_INPUT,
                   "%ssegment_1.length to %ssegment_3.length: %g m together, but ribbon.plane anticlastic requires a "
                   "ribbon without segments",
                   prefixed, prefixed, segments);
  if (ribbon->ribbon.plasticity && has_other_thickness(ribbon))
    return zp_fail(
        err, ZP_BAD_INPUT,
        "%ssegment_1.thickness to %ssegment_3.thickness: ribbon.plasticity requires segments as thick as the "
        "ribbon, %g m",
        prefixed, prefixed, ribbon->ribbon.thickness);
  if (segments > 0 && ribbon->ribbon.model != ZP_RIBBON_ROD)
    return zp_fail(err, ZP_BAD_INPUT, "%ssegment_1.length = %g m: segments require ribbon.model rod", prefixed,
                   ribbon->segment_1.length);
  return ZP_OK;
}

/* Refuse keys of a lower ribbon if there is none, or if the mechanics of the paper makes both ribbons equal. */
static ZpStatus check_lower(const ZpActuatorDef *def, ZpError *err) {
  const char *given = NULL;
  for (int key = lower_keys.first; key < lower_keys.end && !given; key++)
    if (is_given(def, key)) given = zp_key(key)->name;
  if (given && !zp_def_has_two(def))
    return zp_fail(err, ZP_BAD_INPUT, "%s: requires actuator.kind electro_ribbon or hinge, which have two ribbons",
                   given);
  if (given && def->ribbon.model != ZP_RIBBON_ROD)
    return zp_fail(err, ZP_BAD_INPUT, "%s: requires ribbon.model rod", given);
  return isnan(def->electro.insulator_offset) ? ZP_OK : zp_check_like_insulators(def, "electro.insulator_offset", err);
}

ZpStatus zp_check_ribbons(const ZpActuatorDef *def, ZpError *err) {
  bool platform = def->actuator.kind == ZP_KIND_ELECTRO_RIBBON;
  double flexible = platform ? (def->ribbon.length - def->platform.length) / 2 : def->ribbon.length;
  ZpActuatorDef lower = zp_def_lower(def);
  ZpStatus status = check_segments(def, "", flexible, err);
  if (def->ribbon.plane == ZP_PLANE_ANTICLASTIC && def->ribbon.model != ZP_RIBBON_ROD)
    return zp_fail(err, ZP_BAD_INPUT, "ribbon.plane = anticlastic: requires ribbon.model rod");
  if (status == ZP_OK) status = check_lower(def, err);
  if (status == ZP_OK) status = check_segments(&lower, prefix, flexible, err);
  return status;
}
