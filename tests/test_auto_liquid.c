/* What liquid.model auto, the default, stands for, and that every study takes it: nobody who says nothing about the
 * liquid is refused. */
#include "check_util.h"

/* -- the word -------------------------------------------------------------------------------------- */

/* Every combination of keys beside which auto is a bead: a bead where all are given, else none. */
TEST(test_auto_is_a_bead_where_one_is_modelled) {
  static const struct {
    const char *key;
    double asked, other;
  } of[] = {{"actuator.kind", ZP_KIND_ELECTRO_RIBBON, ZP_KIND_FLANGE},
            {"ribbon.model", ZP_RIBBON_ROD, ZP_RIBBON_MASS_SPRING},
            {"solver.integrator", ZP_INTEGRATOR_IMPLICIT, ZP_INTEGRATOR_EXPLICIT},
            {"contact.model", ZP_CONTACT_UNILATERAL, ZP_CONTACT_SEQUENTIAL},
            {"electro.surface", ZP_SURFACE_POLYLINE, ZP_SURFACE_BEZIER},
            {"electro.edges", false, true},
            {"insulator.resistivity", NAN, 1e12},
            {"medium.resistivity", NAN, 1e12}};
  enum { KEYS = LENGTH_OF(of) };
  for (unsigned set = 0; set < 1u << KEYS; set++) {
    Setting list[KEYS];
    ZpActuatorDef def = {0};
    for (size_t k = 0; k < KEYS; k++)
      list[k] = (Setting){of[k].key, set >> k & 1 ? of[k].other : of[k].asked};
    ck_assert_int_eq(resolve(&def, list, KEYS, NULL), ZP_OK);
    ck_assert_int_eq(def.liquid.model, ZP_LIQUID_AUTO);
    ck_assert_msg(zp_def_liquid(&def) == (set ? ZP_LIQUID_NONE : ZP_LIQUID_BEAD), "combination %u", set);
  }
}

TEST(test_other_words_stand_for_themselves) {
  for (int model = ZP_LIQUID_NONE; model <= ZP_LIQUID_BEAD; model++) {
    ZpActuatorDef def = DEF({"liquid.model", model}, {"electro.edges", true});
    ck_assert_int_eq(zp_def_liquid(&def), model);
  }
  ck_assert_int_eq(zp_def_liquid(NULL), ZP_LIQUID_NONE);
}

/* The paper has no liquid, also where a preset is brought to what could have one. */
TEST(test_presets_have_none) {
  for (int preset = ZP_PRESET_NONE + 1; preset < ZpPreset_COUNT; preset++) {
    Setting list[] = {{"preset", preset},
                      {"actuator.kind", ZP_KIND_ELECTRO_RIBBON},
                      {"ribbon.model", ZP_RIBBON_ROD},
                      {"solver.integrator", ZP_INTEGRATOR_IMPLICIT},
                      {"contact.model", ZP_CONTACT_UNILATERAL},
                      {"electro.surface", ZP_SURFACE_POLYLINE}};
    ZpActuatorDef def = {0};
    ck_assert_int_eq(resolve(&def, list, LENGTH_OF(list), NULL), ZP_OK);
    ck_assert_int_eq(def.liquid.model, ZP_LIQUID_NONE);
  }
}

/* -- studies --------------------------------------------------------------------------------------- */

/* Summaries of two runs have the same bits, wall times aside. */
static void ck_same_scalars(const ZpResult *a, const ZpResult *b) {
  ck_assert_uint_eq(a->scalars, b->scalars);
  for (size_t k = 0; k < a->scalars; k++) {
    double x = a->scalar[k].value, y = b->scalar[k].value;
    bool of_clock = strcmp(a->scalar[k].name, "real_time_factor") == 0;
    ck_assert_msg(of_clock || x == y || (isnan(x) && isnan(y)), "%s: %.17g, %.17g", a->scalar[k].name, x, y);
  }
}

static const ZpStudy studies[] = {ZP_STUDY_STATIONARY, ZP_STUDY_EQUILIBRIUM, ZP_STUDY_LIMITS, ZP_STUDY_ISOMETRIC,
                                  ZP_STUDY_PROFILE,    ZP_STUDY_MODES,       ZP_STUDY_ACTUATE};

/* Auto is what it stands for, in every study, with and without what a bead does not know; a note says where it is none.
 */
TESTS(test_auto_runs_as_what_it_stands_for, 0, LENGTH_OF(studies)) {
  static const struct {
    const char *key;
    double value;
    ZpLiquidModel liquid;
    const char *says;
  } of[] = {{"load.mass", 8e-3, ZP_LIQUID_BEAD, NULL},
            {"electro.edges", true, ZP_LIQUID_NONE, "electro.edges or a resistivity is given"},
            {"medium.resistivity", 1e12, ZP_LIQUID_NONE, "electro.edges or a resistivity is given"},
            {"ribbon.model", ZP_RIBBON_MASS_SPRING, ZP_LIQUID_NONE, "requires ribbon.model rod"},
            {"actuator.kind", ZP_KIND_HINGE, ZP_LIQUID_NONE, "use liquid.model none"}};
  ZpStudy study = studies[_i];
  for (size_t k = 0; k < LENGTH_OF(of); k++) {
    ZpActuatorDef def =
        DEF({"mesh.nodes", 11}, {"solver.end_time", 5e-3}, {of[k].key, of[k].value}, {"liquid.model", ZP_LIQUID_AUTO});
    if (k > 0 && zp_study_check(study, &def, NULL) != ZP_OK)
      continue; /* the study does not know that key's value at all */
    ZpResult *given = study_of(study, &def);
    bool draws = study != ZP_STUDY_STATIONARY && study != ZP_STUDY_PROFILE && study != ZP_STUDY_MODES;
    ck_assert_int_eq(note_of(given, "liquid.model auto means none") != NULL, draws && of[k].says);
    if (draws && of[k].says) ck_assert_ptr_nonnull(note_of(given, of[k].says));
    def.liquid.model = of[k].liquid;
    ZpResult *said = study_of(study, &def);
    ck_same_scalars(given, said);
    ck_assert_ptr_null(note_of(said, "liquid.model auto"));
  }
}

/* Frequencies have no bead in them and say so; a bath, far heavier than the ribbons, is refused (test_liquid). */
TEST(test_modes_leave_the_bead_out) {
  ZpActuatorDef bead = DEF({"mesh.nodes", 11}, {"liquid.model", ZP_LIQUID_AUTO}), dry = DEF({"mesh.nodes", 11});
  ZpResult *with = study_of(ZP_STUDY_MODES, &bead), *without = study_of(ZP_STUDY_MODES, &dry);
  ck_same_scalars(with, without);
  ck_assert(notes_with(with, "the bead is ignored") == 1 && notes_with(without, "bead") == 0);
}
