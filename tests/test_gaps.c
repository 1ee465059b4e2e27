/* What changes of single tokens of the source showed to be unchecked: each test names what could be wrong without any
 * other noticing. */
#include "check_util.h"

#include "drive/waveform.h"

/* -- drive ----------------------------------------------------------------------------------------- */

static ZpActuatorDef square_wave(double duty, double rise_time) {
  ZpActuatorDef def = DEF({"drive.waveform", ZP_WAVEFORM_SQUARE}, {"drive.frequency", 20}, {"drive.voltage", 5e3},
                          {"drive.offset", 1e3}, {"drive.duty", duty});
  def.drive.rise_time = rise_time;
  return def;
}

/* A rise of twice what fits was accepted unless duty was one half. What fits just so is a wave without a jump that
 * comes to both of its voltages; longer is refused whichever part, the high or the low one, is the shorter. */
START_TEST(square_wave_rises_within_its_shorter_part) {
  static const double duties[] = {0.2, 0.5, 0.8};
  double duty = duties[_i], shorter = fmin(duty, 1 - duty) / 20;
  ZpActuatorDef def = square_wave(duty, shorter);
  ZpError err = {ZP_OK, ""};
  ck_assert_msg(zp_def_check(&def, &err) == ZP_OK, "%s", err.message);
  ZpWaveform wave = zp_waveform_of(&def, NULL);
  ck_near(zp_waveform_voltage(&wave, shorter), 5e3, 1e-9);
  ck_near(zp_waveform_voltage(&wave, 0.05 - 1e-12), 1e3, 1e-6);
  for (double t = 0; t < 0.2; t = zp_waveform_next_corner(&wave, t))
    ck_near(zp_waveform_voltage_before(&wave, t), zp_waveform_voltage(&wave, t), 1e-9);
  for (double factor = 1.001; factor < 5; factor *= 1.5) {
    def = square_wave(duty, factor * shorter);
    ck_assert_msg(zp_def_check(&def, &err) == ZP_BAD_INPUT, "%g times what fits was taken", factor);
    ck_assert_ptr_nonnull(strstr(err.message, "drive.rise_time"));
  }
}
END_TEST

int main(void) {
  Suite *suite = suite_create("gaps");
  TCase *c = tcase_create("gaps");
  tcase_add_loop_test(c, square_wave_rises_within_its_shorter_part, 0, 3);
  suite_add_tcase(suite, c);
  return run_suite(suite);
}
