/* The page leaves the two-dimensional field out: what stands here in place of src/electro/field.c, surplus.c and
 * src/study/profile.c is never reached, because zp_web_resolve refuses what would need it. */
#include <math.h>

#include "base/fail.h"
#include "electro/surplus.h"
#include "study/studies.h"

ZpFieldMesh zp_field_mesh(void) {
  return (ZpFieldMesh){0};
}

const char *zp_field_words(ZpFieldEnd end) {
  (void)end;
  return "the field is left out";
}

bool zp_field_create(const ZpFieldParams *params, ZpField *field) {
  (void)params, (void)field;
  return false;
}

void zp_field_destroy(ZpField *field) {
  (void)field;
}

ZpFieldEnd zp_field_solve(ZpField *field, const ZpFaces *faces) {
  (void)field, (void)faces;
  return ZP_FIELD_SINGULAR;
}

double zp_grid_energy(const ZpGrid *grid) {
  (void)grid;
  return NAN;
}

bool zp_surplus_create(const ZpFieldParams *field, const ZpPlatesParams *plates, double scale, ZpSurplus *surplus) {
  (void)field, (void)plates, (void)scale, (void)surplus;
  return false;
}

void zp_surplus_destroy(ZpSurplus *surplus) {
  (void)surplus;
}

ZpFieldEnd zp_surplus_solve(ZpSurplus *surplus, const double *q, double voltage) {
  (void)surplus, (void)q, (void)voltage;
  return ZP_FIELD_SINGULAR;
}

ZpStatus zp_study_profile(const ZpTask *task, ZpResult *result, ZpError *err) {
  (void)task, (void)result;
  return zp_check_profile(NULL, err);
}

ZpStatus zp_check_profile(const ZpActuatorDef *def, ZpError *err) {
  (void)def;
  return zp_fail(err, ZP_BAD_INPUT, "study = profile: needs the two-dimensional field");
}
