/* The ground floor: tables and films that thin themselves, memory, errors; the table of keys, the order in
 * which a Def is resolved, presets and cross-checks; saving and restoring a simulation.
 *
 * Against: the documented rule of thinning (the stride is the least power of two with which all offered
 * rows would fit), keys.def read a second time, the defaults and presets as the user's manual lists them
 * (typed in here by hand), and a run that continues against the same run restored, bit for bit. */
#include "check_util.h"

#include "base/fail.h"
#include "base/kernel.h"
#include "base/memory.h"
#include "def/check.h"
#include "def/tolerance.h"

/* -- tables and films ------------------------------------------------------------------------------ */

static const ZpColumn two_columns[] = {{"time_s", "s", ""}, {"square", "1", ""}};

/* What thinning must arrive at after `offered` rows. */
static size_t stride_after(size_t offered, size_t capacity) {
  size_t stride = 1;
  while ((offered + stride - 1) / stride > capacity)
    stride *= 2;
  return stride;
}

static void offer_square(ZpTable *table, size_t i) {
  double t = (double)i, row[2] = {t, t * t};
  zp_table_offer(table, row);
}

static void check_thinned(const ZpTable *table, size_t offered) {
  size_t stride = stride_after(offered, table->capacity);
  ck_assert_uint_eq(table->stride, stride);
  ck_assert_uint_eq(table->rows, (offered + stride - 1) / stride);
  ck_assert_uint_le(table->rows, table->capacity);
  for (size_t r = 0; r < table->rows; r++) {
    double t = (double)(r * stride);
    ck_assert_double_eq(zp_table_get(table, r, "time_s"), t);
    ck_assert_double_eq(zp_table_get(table, r, "square"), t * t);
  }
}

TEST(test_table_thins) {
  static const size_t capacities[] = {2, 3, 7, 10, 64};
  for (size_t c = 0; c < LENGTH_OF(capacities); c++) {
    ZpTable *table = zp_table_create(two_columns, 2, capacities[c]);
    for (size_t i = 0; i < 1000; i++) {
      offer_square(table, i);
      check_thinned(table, i + 1);
    }
    zp_table_destroy(table);
  }
}

TEST(test_table_keeps_last) {
  ZpTable *table = zp_table_create(two_columns, 2, 10);
  for (size_t i = 0; i < 15; i++) /* stride 2, rows 0 2 .. 14: 8 of 10 */
    offer_square(table, i);
  double last[2] = {14.5, 0};
  zp_table_keep_last(table, last);
  ck_assert_uint_eq(table->rows, 9);
  ck_assert_double_eq(zp_table_get(table, 8, "time_s"), 14.5);
  last[1] = 7; /* the same time: is there already */
  zp_table_keep_last(table, last);
  ck_assert_uint_eq(table->rows, 9);
  ck_assert_double_eq(zp_table_get(table, 8, "square"), 0);
  last[0] = 15;
  zp_table_keep_last(table, last);
  ck_assert_uint_eq(table->rows, 10);
  last[0] = 16; /* full: in the place of the last */
  zp_table_keep_last(table, last);
  ck_assert_uint_eq(table->rows, 10);
  ck_assert_double_eq(zp_table_get(table, 9, "time_s"), 16);
  ck_assert_double_eq(zp_table_get(table, 0, "time_s"), 0);
  ck_assert_double_nan(zp_table_get(table, 0, "no such column"));
  ck_assert_double_nan(zp_table_get(table, 0, "time")); /* not by the beginning of time_s */
  ck_assert_double_nan(zp_table_get(table, 10, "time_s"));
  zp_table_destroy(table);
  zp_table_destroy(NULL);
}

enum { FILM_NODES = 5 };

static void offer_frame(ZpShapes *film, size_t i, bool last) {
  double x[2 * FILM_NODES], y[2 * FILM_NODES], gap[FILM_NODES], force[FILM_NODES];
  double field[FILM_NODES], stress[2 * FILM_NODES];
  for (size_t j = 0; j < 2 * FILM_NODES; j++) {
    x[j] = (double)(100 * i + j);
    y[j] = -x[j];
    gap[j / 2] = x[j] / 2;
    force[j / 2] = x[j] / 4;
    field[j / 2] = x[j] / 8;
    stress[j] = x[j] / 3;
  }
  bool facing = film->ribbons == 2;
  ZpShape shape = {.time = (double)i,
                   .voltage = 5,
                   .zipped = i,
                   .x = x,
                   .y = y,
                   .gap = facing ? gap : NULL,
                   .line_force = facing ? force : NULL,
                   .insulator_field = facing ? field : NULL,
                   .stress = facing ? stress : NULL};
  if (last)
    zp_shapes_keep_last(film, &shape);
  else
    zp_shapes_offer(film, &shape);
}

static void check_frame(const ZpShapes *film, size_t frame, size_t i) {
  ZpShape shape = zp_shapes_get(film, frame);
  ck_assert_double_eq(shape.time, (double)i);
  ck_assert_double_eq(shape.voltage, 5);
  ck_assert_uint_eq(shape.zipped, i);
  double end = (double)(100 * i + film->ribbons * FILM_NODES - 1);
  ck_assert_double_eq(shape.x[film->ribbons * FILM_NODES - 1], end);
  ck_assert_double_eq(shape.y[film->ribbons * FILM_NODES - 1], -end);
  if (film->ribbons == 1) {
    ck_assert_ptr_null(shape.gap);
    ck_assert_ptr_null(shape.line_force);
    ck_assert_ptr_null(shape.insulator_field);
    ck_assert_ptr_null(shape.stress);
    return;
  }
  ck_assert_double_eq(shape.gap[FILM_NODES - 1], end / 2);
  ck_assert_double_eq(shape.line_force[FILM_NODES - 1], end / 4);
  ck_assert_double_eq(shape.insulator_field[FILM_NODES - 1], end / 8);
  ck_assert_double_eq(shape.stress[2 * FILM_NODES - 1], end / 3);
}

TEST(test_film_thins) {
  for (size_t ribbons = 1; ribbons <= 2; ribbons++) {
    ZpShapes *film = zp_shapes_create(ribbons, FILM_NODES, 6);
    for (size_t i = 0; i < 100; i++)
      offer_frame(film, i, false);
    size_t stride = stride_after(100, 6);
    ck_assert_uint_eq(film->stride, stride);
    ck_assert_uint_le(film->frames, 6);
    for (size_t f = 0; f < film->frames; f++)
      check_frame(film, f, f * stride);
    offer_frame(film, 99, true);
    check_frame(film, film->frames - 1, 99);
    check_frame(film, 0, 0);
    ck_assert_uint_le(film->frames, 6);
    zp_shapes_destroy(film);
  }
  zp_shapes_destroy(NULL);
}

/* The lower ribbon as it was, the upper one with its heights reversed; what is of stations once. */
TEST(test_film_is_mirrored) {
  static const double x[] = {1, 2, 3}, y[] = {0, -5, -6}, stress[] = {7, 8, 9}, gap[] = {10, 11, 12},
                      force[] = {13, 14, 15}, field[] = {16, 17, 18};
  ZpShapes *film = zp_shapes_create(1, 3, 6);
  for (size_t k = 0; k < 2; k++)
    zp_shapes_offer(film, &(ZpShape){(double)k, 5, k, x, y, gap, force, field, stress});
  ZpShapes *both = zp_shapes_mirrored(film, 1);
  ck_assert_uint_eq(zp_shapes_ribbons(both), 2);
  ck_assert_uint_eq(zp_shapes_frames(both), 2);
  const ZpShape last = zp_shapes_get(both, 1);
  ck_assert_double_eq(last.time, 1);
  ck_assert_uint_eq(last.zipped, 1);
  for (size_t i = 0; i < 6; i++) {
    ck_assert_double_eq(last.x[i], x[i / 2]);
    ck_assert_double_eq(last.y[i], i % 2 ? y[i / 2] : -y[i / 2]);
    ck_assert_double_eq(last.stress[i], stress[i / 2]);
    ck_assert_double_eq(last.gap[i / 2], 2 * gap[i / 2]);
  }
  ck_assert_mem_eq(last.line_force, force, sizeof force);
  ck_assert_mem_eq(last.insulator_field, field, sizeof field);
  zp_shapes_destroy(film);
  zp_shapes_destroy(both);
}

/* -- memory and errors ----------------------------------------------------------------------------- */

TEST(test_carver) {
  static const size_t counts[] = {1, 7, 8, 9, 0, 64, 1001};
  enum { ARRAYS = LENGTH_OF(counts) };
  ZpArena measure = {NULL, 0};
  for (int k = 0; k < ARRAYS; k++)
    ck_assert_ptr_null(zp_arena_take(&measure, counts[k]));
  char *block = zp_calloc(1, measure.used);
  ZpArena arena = {block, 0};
  double *array[ARRAYS];
  for (int k = 0; k < ARRAYS; k++) {
    array[k] = zp_arena_take(&arena, counts[k]);
    ck_assert_uint_eq((uintptr_t)array[k] % ZP_ALIGNMENT, 0);
  }
  ck_assert_uint_eq(arena.used, measure.used);
  for (int k = 0; k < ARRAYS; k++) { /* writing one to its end touches no other */
    const char *end = (const char *)(array[k] + counts[k]);
    ck_assert_uint_le((size_t)(end - block), measure.used);
    if (k + 1 < ARRAYS) ck_assert(end <= (const char *)array[k + 1]);
  }
  zp_free(block);
}

TEST(test_calloc) {
  unsigned char *memory = zp_calloc(3, 7);
  ck_assert_uint_eq((uintptr_t)memory % ZP_ALIGNMENT, 0);
  for (int i = 0; i < 21; i++)
    ck_assert_uint_eq(memory[i], 0);
  zp_free(memory);
  memory = zp_calloc(0, 8);
  ck_assert_ptr_nonnull(memory);
  zp_free(memory);
  ck_assert_ptr_null(zp_calloc(SIZE_MAX / 4, 8)); /* overflows */
  ck_assert_ptr_null(zp_calloc(SIZE_MAX, 1));
  zp_free(NULL);
}

TEST(test_lanes) {
  for (size_t n = 0; n < 100; n++) {
    size_t rounded = zp_round_up(n);
    ck_assert_uint_eq(rounded % ZP_LANES, 0);
    ck_assert(rounded >= n && rounded < n + ZP_LANES);
  }
  static const double lanes[ZP_LANES] = {1, -2, 4, -8, 16, -32, 64, -128};
  ck_assert_double_eq(zp_sum_lanes(lanes), -85);
  ck_assert_double_eq(zp_max_lanes(lanes), 64);
}

TEST(test_fail) {
  ZpError err = {ZP_OK, ""};
  ck_assert_int_eq(zp_fail(&err, ZP_BAD_INPUT, "%s = %g", "x", 2.5), ZP_BAD_INPUT);
  ck_assert_int_eq(err.status, ZP_BAD_INPUT);
  ck_assert_str_eq(err.message, "x = 2.5");
  ck_assert_int_eq(zp_fail(NULL, ZP_MACHINE, "nobody listens"), ZP_MACHINE);
  char word[2000];
  memset(word, 'w', sizeof word);
  word[sizeof word - 1] = 0;
  zp_fail(&err, ZP_MACHINE, "%s", word); /* cut, not overrun */
  ck_assert_uint_eq(strlen(err.message), sizeof err.message - 1);
  ck_assert_int_eq(zp_fail_memory(&err), ZP_MACHINE);
  ck_assert_str_eq(err.message, "no memory");
}

/* -- keys ------------------------------------------------------------------------------------------ */

/* keys.def once more: the fields of a default Def and the rows of the table. */
static void check_key(int *index, const char *name, double field, double def, double min, double max) {
  const ZpKey *key = zp_key(*index);
  ZpActuatorDef defaults = zp_actuator_def_default();
  ck_assert_str_eq(key->name, name);
  ck_assert_int_eq(zp_key_find(name), *index);
  ck_assert_msg(field == def || (isnan(field) && isnan(def)), "%s: default %g, not %g", name, field, def);
  double got = zp_def_get(&defaults, *index);
  ck_assert(got == def || (isnan(got) && isnan(def)));
  ck_assert_double_eq(key->min, min);
  ck_assert_double_eq(key->max, max);
  ck_assert_uint_gt(strlen(key->help), 0);
  ++*index;
}

/* The rows of segments, by the last one. */
static void check_segment(int *i, const ZpActuatorDef *def) {
  for (const int first = *i; zp_key_is_row(*i) && zp_instance_most(*i) == zp_instance_most(first); (*i)++) {
    const double value = zp_def_get(def, zp_key_of_instance(*i, ZP_MOST_SEGMENTS)), plain = zp_key(*i)->def;
    ck_assert(value == plain || (isnan(value) && isnan(plain)));
  }
}

TEST(test_defaults_are_those_of_keys_def) {
  ZpActuatorDef d = zp_actuator_def_default();
  int i = 0;
#define ZP_GROUP(group)
#define ZP_GROUP_END(group)
#define ZP_REAL(path, name, unit, shown, def, min, max, help) check_key(&i, #path #name, d.path name, def, min, max);
#define ZP_REAL_AS(path, field, name, unit, shown, def, min, max, help)                                                \
  check_key(&i, #path #name, d.path field, def, min, max);
#define ZP_REAL_AUTO(path, name, unit, shown, min, max, help) check_key(&i, #path #name, d.path name, NAN, min, max);
#define ZP_REAL_OR_AUTO(path, name, unit, shown, def, min, max, help)                                                  \
  check_key(&i, #path #name, d.path name, def, min, max);
#define ZP_REAL_NONE(path, name, unit, shown, min, max, help) check_key(&i, #path #name, d.path name, NAN, min, max);
#define ZP_INT(path, name, def, min, max, help)               check_key(&i, #path #name, d.path name, def, min, max);
#define ZP_BOOL(path, name, def, help)                        check_key(&i, #path #name, d.path name, def, 0, 1);
#define ZP_ENUM(path, name, type, def, help)                  check_key(&i, #path #name, d.path name, def, 0, (double)type##_COUNT - 1);
#define ZP_OF_SCENARIO(name, type, def, help)                 check_key(&i, #name, NAN, NAN, 0, (double)type##_COUNT - 1);
#define ZP_TEXT(path, name, def, help)                                                                                 \
  ck_assert_str_eq(d.path name, def);                                                                                  \
  check_key(&i, #path #name, NAN, NAN, 0, ZP_TEXT_SIZE - 1);
#define ZP_MANY(group, ...) check_segment(&i, &d);
#include "def/keys.def"
  ck_assert_int_eq(i, zp_key_count());
  ZpError err;
  ck_assert_int_eq(zp_def_check(&d, &err), ZP_OK);
}

/* Word of a choice key's value. */
static const char *word_of(const ZpActuatorDef *def, const char *name) {
  int index = zp_key_find(name);
  return zp_key(index)->choices[(int)zp_def_get(def, index)].word;
}

/* A key with a value, or, where `word` is given, with that choice. */
typedef struct Expected {
  const char *key;
  double value;
  const char *word;
} Expected;

static void check_expected(const ZpActuatorDef *def, const Expected *list, size_t count) {
  for (size_t i = 0; i < count; i++) {
    int index = zp_key_find(list[i].key);
    ck_assert_msg(index >= 0, "no key %s", list[i].key);
    double value = zp_def_get(def, index);
    if (list[i].word)
      ck_assert_str_eq(word_of(def, list[i].key), list[i].word);
    else if (isnan(list[i].value))
      ck_assert_msg(isnan(value), "%s = %g, not auto", list[i].key, value);
    else
      ck_assert_msg(value == list[i].value, "%s = %.17g, expected %.17g", list[i].key, value, list[i].value);
  }
}

/* As promised to users, independent of keys.def. */
TEST(test_defaults_are_those_promised) {
  static const Expected promised[] = {
      {"actuator.kind", 0, "electro_ribbon"},
      {"actuator.right_end", 0, "guided"},
      {"ribbon.length", 0.1, NULL},
      {"ribbon.width", 0.0127, NULL},
      {"ribbon.thickness", 50e-6, NULL},
      {"ribbon.young_modulus", 200e9, NULL},
      {"ribbon.poisson_ratio", 0.285, NULL},
      {"ribbon.density", 7850, NULL},
      {"ribbon.plane", 0, "strain"},
      {"ribbon.model", 0, "rod"},
      {"platform.length", 0.01, NULL},
      {"platform.electrode", 1, NULL},
      {"insulator.thickness", 130e-6, NULL},
      {"insulator.permittivity", 4.62, NULL},
      {"insulator.density", 0, NULL},
      {"insulator.young_modulus", 0, NULL},
      {"insulator.breakdown_field", 40e6, NULL},
      {"medium.permittivity", 2.75, NULL},
      {"medium.breakdown_field", 20e6, NULL},
      {"load.mass", 0.008, NULL},
      {"load.share", 0.5, NULL},
      {"gravity", 9.81, NULL},
      {"mesh.nodes", 61, NULL},
      {"mass_spring.shear_coefficient", NAN, NULL},
      {"mass_spring.axial", 0, "text"},
      {"electro.model", 0, "plates"},
      {"electro.surface", 0, "polyline"},
      {"electro.force_scale", 1, NULL},
      {"electro.voltage_share", 1, NULL},
      {"electro.insulator_offset", NAN, NULL},
      {"electro.breakdown_cap", 1, NULL},
      {"contact.model", 0, "unilateral"},
      {"drive.voltage", 10e3, NULL},
      {"damping.drag", 0, NULL},
      {"solver.integrator", 0, "implicit"},
      {"solver.end_time", 1, NULL},
      {"solver.tolerance", NAN, NULL},
      {"solver.time_step", NAN, NULL},
      {"initial.state", 0, "equilibrium"},
      {"preset", 0, "none"},
  };
  ZpActuatorDef def = zp_actuator_def_default();
  check_expected(&def, promised, LENGTH_OF(promised));
}

TEST(test_key_words) {
  int kind = zp_key_find("actuator.kind");
  ck_assert_int_eq(zp_key_choice(kind, "electro_ribbon"), ZP_KIND_ELECTRO_RIBBON);
  ck_assert_int_eq(zp_key_choice(kind, "ribbon"), ZP_KIND_RIBBON);
  ck_assert_int_eq(zp_key_choice(kind, "ribbons"), -1);
  ck_assert_int_eq(zp_key_choice(zp_key_find("load.mass"), "ribbon"), -1);
  ck_assert_int_eq(zp_key_find("load.mas"), -1);
}

TEST(test_key_nearest) {
  static const char *const pairs[][2] = {
      {"ribbon.lenght", "ribbon.length"},
      {"ribon.width", "ribbon.width"},
      {"voltage", "drive.voltage"},
      {"drive.volts", "drive.voltage"},
      {"nodes", "mesh.nodes"},
      {"load.mas", "load.mass"},
      {"solver.end-time", "solver.end_time"},
      {"Gravity", "gravity"},
      {"damping.drag", "damping.drag"},
      {"load.weight", "load.mass"},
      {"medium.viscosity", "medium.kinematic_viscosity"},
      {"ribbon.young", "ribbon.young_modulus"},
      {"electro.breakdowncap", "electro.breakdown_cap"},
  };
  for (size_t i = 0; i < LENGTH_OF(pairs); i++)
    ck_assert_str_eq(zp_key_nearest(pairs[i][0]), pairs[i][1]);
  ck_assert_ptr_nonnull(zp_key_nearest(""));
  char word[500];
  memset(word, 'q', sizeof word);
  word[sizeof word - 1] = 0;
  ck_assert_ptr_nonnull(zp_key_nearest(word));
}

/* Names from other programs and papers lead to ours; what is not modelled has no nearest key. */
TEST(test_key_unknown) {
  static const char *const pairs[][2] = {
      {"load.mas", "unknown key; did you mean load.mass?"},
      {"tape.thickness", "unknown key; did you mean insulator.thickness?"},
      {"Oil.viscosity", "unknown key; did you mean medium.kinematic_viscosity?"},
      {"viscosity", "unknown key; did you mean medium.kinematic_viscosity?"},
      {"ribbon.E", "unknown key; did you mean ribbon.young_modulus?"},
      {"electro.fringing", "unknown key; did you mean electro.edges?"},
      {"solver.dt", "unknown key; did you mean solver.time_step?"},
      {"load.time", "unknown key; did you mean load.change_time?"},
      {"Glue.thickness", "glue is not modelled; add its thickness to insulator.thickness"},
      {"ribbon_fatigue", "fatigue is not modelled; yield_margin says how far stresses are from yield"},
      {"magnet.strength", "magnetism is not modelled"},
      {"magnetic_field", "magnetism is not modelled"},
      {"thermal.expansion",
       "temperature is not modelled; give the properties at that temperature, such as medium.kinematic_viscosity"},
      {"humid", "humidity is not modelled; give insulator.resistivity and air.breakdown_field at that humidity"},
      {"ribbon.lifetime", "lifetime is not modelled; breakdown_margin and yield_margin say how far fields and stresses "
                          "are from their limits"},
      {"buoyancy", "buoyancy of the load is not modelled; subtract it from load.mass"},
      {"electrolysis", "electrolysis is not modelled"},
      {"insulator.viscosity", "unknown key; insulator has material, thickness, permittivity, density, young_modulus, "
                              "breakdown_field, relaxation_modulus, relaxation_time, resistivity"},
      {"oil.colour",
       "unknown key; medium has material, permittivity, breakdown_field, kinematic_viscosity, density, mean_free_path, "
       "surface_tension, drag_coefficient, resistivity"},
      {"cost", "unknown key, and none has a similar name; zipact keys lists all"},
      {"skin_effect", "unknown key, and none has a similar name; zipact keys lists all"},
      {"acceleration", "unknown key, and none has a similar name; zipact keys lists all"},
      {"flow.velocity", "unknown key, and none has a similar name; zipact keys lists all"},
      {"young", "unknown key; did you mean ribbon.young_modulus?"},
      {"lenght", "unknown key; did you mean ribbon.length?"},
      {"load.msas", "unknown key; did you mean load.mass?"},
      {"wire.resistance", "unknown key; did you mean source.resistance?"},
      {"electrode",
       "unknown key; ribbon has material, length, width, thickness, young_modulus, poisson_ratio, density, "
       "yield_stress, plasticity, hardening_modulus, tension, relaxation_modulus, relaxation_time, plane, model"},
  };
  char text[256];
  for (size_t i = 0; i < LENGTH_OF(pairs); i++) {
    zp_key_unknown(pairs[i][0], text, sizeof text);
    ck_assert_str_eq(text, pairs[i][1]);
  }
  zp_key_unknown("lower.colour", text, sizeof text); /* groups within the group */
  ck_assert_str_eq(text, "unknown key; lower has ribbon, segment_K, insulator");
  zp_key_unknown("ribbon.colour", text, 80); /* more keys than fit */
  ck_assert_str_eq(text + strlen(text) - 5, ", ...");
  for (int i = 0; i < zp_key_count(); i++) { /* no part of a key is said not to be modelled */
    zp_key_unknown(zp_key(i)->name, text, sizeof text);
    ck_assert_msg(!strstr(text, "not modelled"), "%s: %s", zp_key(i)->name, text);
  }
  char word[500], little[8];
  memset(word, '.', sizeof word);
  word[sizeof word - 1] = 0;
  zp_key_unknown(word, little, sizeof little);
  ck_assert_str_eq(little, "unknown");
}

/* -- resolving ------------------------------------------------------------------------------------- */

TEST(test_resolve_order) {
  ck_assert_double_eq(zp_actuator_def_default().load.share, 0.5);
  ck_assert_double_eq(DEF({"actuator.kind", ZP_KIND_RIBBON}).load.share, 1); /* kind over default */
  ck_assert_double_eq(
      DEF({"actuator.kind", ZP_KIND_RIBBON}, {"preset", ZP_PRESET_PAPER_CODE}, {"mesh.nodes", 21}).load.share,
      0.25); /* preset over kind */
  ck_assert_double_eq(
      DEF({"load.share", 0.7}, {"actuator.kind", ZP_KIND_RIBBON}, {"preset", ZP_PRESET_PAPER_CODE}, {"mesh.nodes", 21})
          .load.share,
      0.7); /* assignment over all, wherever it stands */
  ck_assert_double_eq(DEF({"load.mass", 1e-3}, {"load.mass", 2e-3}).load.mass, 2e-3); /* the later wins */
  ZpActuatorDef plain = DEF({"preset", ZP_PRESET_PAPER_CODE}, {"preset", ZP_PRESET_NONE});
  ck_assert_double_eq(plain.ribbon.thickness, 50e-6); /* of presets, too */
}

TEST(test_paper_text) {
  static const Expected text[] = {
      {"ribbon.model", 0, "mass_spring"},
      {"contact.model", 0, "sequential"},
      {"solver.integrator", 0, "explicit"},
      {"electro.surface", 0, "bezier"},
      {"ribbon.thickness", 50e-6, NULL},
      {"mass_spring.axial", 0, "text"},
      {"mass_spring.shear_coefficient", NAN, NULL},
      {"load.share", 0.5, NULL},
      {"electro.force_scale", 6.03, NULL},
      {"electro.voltage_share", 0.5, NULL},
      {"electro.insulator_offset", NAN, NULL},
      {"electro.breakdown_cap", 1, NULL},
      {"platform.electrode", 0, NULL},
      {"load.mass", 8e-3, NULL},
      {"ribbon.length", 0.1, NULL},
      {"platform.length", 0.01, NULL},
  };
  static const double drag[][2] = {{21, 10}, {61, 1}, {130, 0.1}};
  for (size_t i = 0; i < LENGTH_OF(drag); i++) {
    ZpActuatorDef def = DEF({"preset", ZP_PRESET_PAPER_TEXT}, {"mesh.nodes", drag[i][0]});
    check_expected(&def, text, LENGTH_OF(text));
    ck_assert_double_eq(def.damping.drag, drag[i][1]);
  }
}

TEST(test_paper_code) {
  static const Expected code[] = {
      {"ribbon.model", 0, "mass_spring"},
      {"contact.model", 0, "sequential"},
      {"solver.integrator", 0, "explicit"},
      {"electro.surface", 0, "bezier"},
      {"ribbon.thickness", 100e-6, NULL},
      {"mass_spring.axial", 0, "code"},
      {"load.share", 0.25, NULL},
      {"electro.force_scale", 6.6, NULL},
      {"electro.voltage_share", 1, NULL},
      {"electro.insulator_offset", 182.6e-6, NULL},
      {"electro.breakdown_cap", 0, NULL},
      {"platform.electrode", 0, NULL},
      {"electro.refresh_period", 10e-3, NULL},
      {"contact.complete_margin", 4, NULL},
  };
  static const double at[][4] = {{21, 6434, 10, 5e-6}, {61, 158603, 100, 1e-6}, {130, 1.537e6, 0.1, 0.5e-6}};
  for (size_t i = 0; i < LENGTH_OF(at); i++) {
    ZpActuatorDef def = DEF({"preset", ZP_PRESET_PAPER_CODE}, {"mesh.nodes", at[i][0]});
    check_expected(&def, code, LENGTH_OF(code));
    ck_assert_double_eq(def.mass_spring.shear_coefficient, at[i][1]);
    ck_assert_double_eq(def.damping.drag, at[i][2]);
    ck_assert_double_eq(def.solver.time_step, at[i][3]);
  }
}

TEST(test_preset_must_be_completed) {
  ZpActuatorDef def = {0};
  ZpError err;
  const Setting text[] = {{"preset", ZP_PRESET_PAPER_TEXT}, {"mesh.nodes", 41}, {"damping.drag", 3}};
  ck_says(resolve(&def, text, 2, &err), ZP_BAD_INPUT, "damping.drag");
  ck_says(resolve(&def, text, 2, &err), ZP_BAD_INPUT, "41");
  ck_assert_int_eq(resolve(&def, text, 3, &err), ZP_OK);
  ck_assert_double_eq(def.damping.drag, 3);
  const Setting code[] = {{"preset", ZP_PRESET_PAPER_CODE},
                          {"mesh.nodes", 41},
                          {"damping.drag", 3},
                          {"mass_spring.shear_coefficient", 4e4},
                          {"solver.time_step", 1e-6}};
  for (size_t given = 2; given < 5; given++)
    ck_assert_int_eq(resolve(&def, code, given, &err), ZP_BAD_INPUT);
  ck_assert_int_eq(resolve(&def, code, 5, &err), ZP_OK);
  ck_assert_double_eq(def.mass_spring.shear_coefficient, 4e4);
  ck_assert_double_eq(def.ribbon.thickness, 100e-6);
}

/* Each key at its bounds and beyond; wrong ones leave the Def alone and say what is allowed. */
TESTS(test_set_range, 0, zp_key_count()) {
  const ZpKey *key = zp_key(_i);
  const int index = key_of_one(_i);
  const char *name = ZP_KEY_NAME(index);
  ZpActuatorDef def = zp_actuator_def_default(), before = def;
  ZpError err;
  const double wrong[] = {INFINITY,
                          -INFINITY,
                          nextafter(key->min, -INFINITY),
                          nextafter(key->max, INFINITY),
                          key->type == ZP_KEY_REAL_AUTO ? INFINITY : NAN,
                          key->type == ZP_KEY_REAL || key->type == ZP_KEY_REAL_AUTO ? -INFINITY : 0.5};
  for (size_t i = 0; i < LENGTH_OF(wrong); i++) {
    ck_assert_msg(zp_def_set(&def, index, wrong[i], &err) == ZP_BAD_INPUT, "%s takes %.17g", name, wrong[i]);
    ck_assert_ptr_nonnull(strstr(err.message, name));
    ck_assert_mem_eq(&def, &before, sizeof def);
  }
  if (key->type == ZP_KEY_TEXT) return;
  if (index != _i) ck_says(zp_def_set(&def, _i, key->min, &err), ZP_BAD_INPUT, "give a number, 1 to");
  if (!zp_key_in_def(index)) {
    ck_says(zp_def_set(&def, index, key->min, &err), ZP_BAD_INPUT, "is a key of a scenario");
    return;
  }
  ck_assert_int_eq(zp_def_set(&def, index, key->min, NULL), ZP_OK);
  ck_assert_double_eq(zp_def_get(&def, index), key->min);
  ck_assert_int_eq(zp_def_set(&def, index, key->max, NULL), ZP_OK);
  ck_assert_double_eq(zp_def_get(&def, index), key->max);
  if (key->type == ZP_KEY_REAL_AUTO) {
    ck_assert_int_eq(zp_def_set(&def, index, NAN, NULL), ZP_OK);
    ck_assert(isnan(zp_def_get(&def, index)));
  }
  zp_def_clear(&def);
}

TEST(test_set_message) {
  ZpActuatorDef def = zp_actuator_def_default();
  ZpError err;
  zp_def_set(&def, zp_key_find("ribbon.thickness"), 1, &err);
  static const char *const parts[] = {"ribbon.thickness", "1 m", "1e-06", "0.005 m"};
  for (size_t i = 0; i < LENGTH_OF(parts); i++)
    ck_assert_msg(strstr(err.message, parts[i]) != NULL, "no '%s' in: %s", parts[i], err.message);
}

/* A Def whose fields were assigned is checked when it is used. */
TEST(test_check_ranges) {
  ZpError err;
  ZpActuatorDef def = zp_actuator_def_default();
  def.load.mass = -1;
  ck_says(zp_def_check(&def, &err), ZP_BAD_INPUT, "load.mass");
  ZpModel *model = (ZpModel *)&err;
  ck_assert_int_eq(zp_model_create(&def, &model, &err), ZP_BAD_INPUT);
  ck_assert_ptr_null(model);
  def = zp_actuator_def_default();
  def.ribbon.width = NAN;
  ck_assert_int_eq(zp_def_check(&def, &err), ZP_BAD_INPUT);
  def = zp_actuator_def_default();
  def.contact.model = (ZpContactModel)ZpContactModel_COUNT;
  ck_assert_int_eq(zp_def_check(&def, &err), ZP_BAD_INPUT);
}

/* Settings that are each right and together wrong, and the key that the message must name. */
typedef struct Cross {
  Setting setting[8];
  const char *named;
  bool right; /* the counterpart that is allowed */
  ZpStudy study;
} Cross;

#define SEQUENTIAL                                                                                                     \
  {"contact.model", ZP_CONTACT_SEQUENTIAL}, {                                                                          \
    "solver.integrator", ZP_INTEGRATOR_EXPLICIT                                                                        \
  }

static const Cross crosses[] = {
    {{{"electro.surface", ZP_SURFACE_BEZIER}}, "electro.surface", false, ZP_STUDY_ACTUATE},
    {{{"contact.model", ZP_CONTACT_SEQUENTIAL}}, "contact.model", false, ZP_STUDY_ACTUATE},
    {{SEQUENTIAL}, "", true, ZP_STUDY_ACTUATE},
    {{{"solver.integrator", ZP_INTEGRATOR_EXPLICIT}}, "", true, ZP_STUDY_ACTUATE},
    {{{"solver.integrator", ZP_INTEGRATOR_EXPLICIT}, {"damping.internal", 1e-6}},
     "damping.internal",
     false,
     ZP_STUDY_ACTUATE},
    {{{"ribbon.model", ZP_RIBBON_MASS_SPRING}, {"damping.internal", 1e-6}},
     "damping.internal",
     false,
     ZP_STUDY_ACTUATE},
    {{{"ribbon.model", ZP_RIBBON_MASS_SPRING}}, "", true, ZP_STUDY_ACTUATE},
    {{{"platform.length", 0.0901}}, "platform.length", false, ZP_STUDY_ACTUATE},
    {{{"platform.length", 0.09}}, "", true, ZP_STUDY_ACTUATE},
    {{{"platform.length", 0.5}, {"actuator.kind", ZP_KIND_RIBBON}}, "", true, ZP_STUDY_ACTUATE},
    {{{"insulator.thickness", 0}, {"electro.breakdown_cap", 0}}, "insulator.thickness", false, ZP_STUDY_ACTUATE},
    {{{"insulator.thickness", 0}}, "short circuit", false, ZP_STUDY_ACTUATE},
    {{{"insulator.thickness", 0}, {"electro.insulator_offset", 1e-6}}, "short circuit", false, ZP_STUDY_ACTUATE},
    {{{"insulator.thickness", 0}, {"drive.voltage", 0}}, "", true, ZP_STUDY_ACTUATE},
    {{{"insulator.thickness", 0}}, "short circuit", false, ZP_STUDY_EQUILIBRIUM},
    {{{"insulator.thickness", 0}}, "short circuit", false, ZP_STUDY_ISOMETRIC},
    {{{"insulator.thickness", 0}, {"modes.voltage", 1}}, "short circuit", false, ZP_STUDY_MODES},
    {{{"insulator.thickness", 0}}, "", true, ZP_STUDY_MODES},
    {{{"insulator.thickness", 0}}, "", true, ZP_STUDY_STATIONARY},
    {{{"insulator.thickness", 0}, {"actuator.kind", ZP_KIND_FLANGE}}, "short circuit", false, ZP_STUDY_ACTUATE},
    {{{"insulator.thickness", 0}, {"actuator.kind", ZP_KIND_FLANGE}, {"electro.gap_offset", 1e-4}},
     "",
     true,
     ZP_STUDY_ACTUATE},
    {{{"insulator.thickness", 0}, {"actuator.kind", ZP_KIND_RIBBON}}, "", true, ZP_STUDY_ACTUATE},
    /* an insulator without thickness has no mass, whatever its density */
    {{{"ribbon.density", 0}, {"insulator.density", 1000}}, "", true, ZP_STUDY_ACTUATE},
    {{{"ribbon.density", 0}, {"insulator.density", 1000}, {"insulator.thickness", 0}, {"drive.voltage", 0}},
     "ribbon.density = 0 kg/m3: a moving ribbon needs a mass",
     false,
     ZP_STUDY_ACTUATE},
    {{{"ribbon.density", 0}, {"insulator.density", 1000}, {"insulator.thickness", 0}},
     "ribbon.density = 0 kg/m3: a moving ribbon needs a mass",
     false,
     ZP_STUDY_MODES},
    {{{"electro.insulator_offset", 0}, {"electro.breakdown_cap", 0}}, "electro.breakdown_cap", false, ZP_STUDY_ACTUATE},
    {{{"contact.complete_margin", 60}}, "contact.complete_margin", false, ZP_STUDY_ACTUATE},
    {{{"contact.complete_margin", 59}}, "", true, ZP_STUDY_ACTUATE},
    {{{"electro.switch_offset", 1e-4}}, "electro.switch_offset", false, ZP_STUDY_ACTUATE},
    {{{"electro.switch_offset", 1e-4}, {"electro.surface", ZP_SURFACE_BEZIER}, SEQUENTIAL}, "", true, ZP_STUDY_ACTUATE},
    {{{"electro.refresh_period", 1e-4}}, "electro.refresh_period", false, ZP_STUDY_ACTUATE},
    {{{"electro.refresh_period", 1e-4}, {"electro.surface", ZP_SURFACE_BEZIER}, SEQUENTIAL},
     "",
     true,
     ZP_STUDY_ACTUATE},
    {{{"lower.segment_1.length", 0.06}}, "lower.segment_1.length", false, ZP_STUDY_ACTUATE},
    {{{"lower.ribbon.density", 0}, {"insulator.density", 0}}, "lower.ribbon.density = 0", false, ZP_STUDY_ACTUATE},
    {{{"stack.series", 2}, {"member_3.ribbon.thickness", 60e-6}},
     "member_3.ribbon.thickness: requires stack.series of at least 3",
     false,
     ZP_STUDY_ACTUATE},
    {{{"stack.series", 3}, {"member_3.ribbon.thickness", 60e-6}}, "", true, ZP_STUDY_STATIONARY},
    /* two antagonists span the lengths of both */
    {{{"stack.series", 2}, {"stack.distance", 0.12}}, "", true, ZP_STUDY_ACTUATE},
    {{{"stack.series", 2}, {"stack.distance", 0.2}}, "stack.distance = 0.2 m", false, ZP_STUDY_ACTUATE},
    /* a square wave of 1 s falls in its shorter part, whichever that is */
    {{{"drive.waveform", ZP_WAVEFORM_SQUARE}, {"drive.frequency", 1}, {"drive.duty", 0.9}, {"drive.rise_time", 0.2}},
     "shorter part of the square wave, 0.1 s",
     false,
     ZP_STUDY_ACTUATE},
    {{{"drive.waveform", ZP_WAVEFORM_SQUARE}, {"drive.frequency", 1}, {"drive.duty", 0.1}, {"drive.rise_time", 0.2}},
     "shorter part of the square wave, 0.1 s",
     false,
     ZP_STUDY_ACTUATE},
    {{{"drive.waveform", ZP_WAVEFORM_SQUARE}, {"drive.frequency", 1}, {"drive.duty", 0.75}, {"drive.rise_time", 0.2}},
     "",
     true,
     ZP_STUDY_ACTUATE},
    {{{"control.kind", ZP_CONTROL_PI},
      {"control.signal", ZP_CONTROL_CONTRACTION},
      {"setpoint.value", 0.5},
      {"setpoint.waveform", ZP_WAVEFORM_SINE},
      {"setpoint.offset", 1.2}},
     "a contraction is at most 1",
     false,
     ZP_STUDY_ACTUATE},
    {{{"sense.frequency", 100}, {"sense.sampling_rate", 1000}, {"sense.amplitude", 1}, {"sense.bandwidth", 50}},
     "",
     true,
     ZP_STUDY_ACTUATE},
    {{{"sense.frequency", 100}, {"sense.sampling_rate", 1000}, {"sense.amplitude", 1}, {"sense.bandwidth", 51}},
     "at most half of sense.frequency",
     false,
     ZP_STUDY_ACTUATE},
    /* the whole load may fall off, but no more */
    {{{"load.mass", 8e-3}, {"load.change_mass", -8e-3}, {"load.change_time", 0.1}}, "", true, ZP_STUDY_ACTUATE},
    {{{"load.mass", 8e-3}, {"load.change_mass", -9e-3}, {"load.change_time", 0.1}},
     "cannot drop more than load.mass",
     false,
     ZP_STUDY_ACTUATE},
    {{{"mount.tilt", 3.14159265358979323846}}, "", true, ZP_STUDY_ACTUATE},
    {{{"mount.tilt", 3.1}}, "mount.tilt", false, ZP_STUDY_ACTUATE},
    {{TURNS, {"platform.length", 0.01}, {"load.offset", 5e-3}}, "", true, ZP_STUDY_STATIONARY},
    {{TURNS, {"platform.length", 0.01}, {"load.offset", 6e-3}}, "load.offset = 0.006 m", false, ZP_STUDY_STATIONARY},
};

TESTS(test_check_crosses, 0, LENGTH_OF(crosses)) {
  const Cross *cross = &crosses[_i];
  size_t count = 0;
  while (count < LENGTH_OF(cross->setting) && cross->setting[count].key)
    count++;
  ZpActuatorDef def = def_with(cross->setting, count);
  ZpError err = {ZP_OK, ""};
  ck_assert_int_eq(zp_study_check(cross->study, &def, &err), cross->right ? ZP_OK : ZP_BAD_INPUT);
  ck_assert_msg(strstr(err.message, cross->named) != NULL, "no '%s' in: %s", cross->named, err.message);
}

/* A limit holds for both signs of the voltage, and for that of each antagonist. */
TEST(test_check_voltages) {
  ZpError err;
  ZpActuatorDef def = DEF({"source.model", ZP_SOURCE_AMPLIFIER}, {"source.voltage_limit", 5e3}, {"drive.voltage", 4e3});
  ck_assert_int_eq(zp_def_check_voltage(&def, -5e3, &err), ZP_OK);
  ck_assert_int_eq(zp_def_check_voltage(&def, -6e3, &err), ZP_BAD_INPUT);
  ck_assert_int_eq(zp_def_check_voltage(&def, 6e3, &err), ZP_BAD_INPUT);
  def = DEF({"insulator.thickness", 0}, {"drive.voltage", 0}, {"stack.series", 2}, {"stack.distance", 0.03},
            {"stack.lower_voltage", 5e3});
  ck_says(zp_def_check_voltage(&def, 0, &err), ZP_BAD_INPUT,
          "member 2 of the stack: insulator.thickness = 0 m: 5000 V is a short circuit");
}

/* The load of a series hangs from its last member; parallel members share it; the lower antagonist is the upper one
 * turned over, with its own voltage and without the load. */
TEST(test_members_share_the_load) {
  ZpActuatorDef def = DEF({"stack.series", 3}, {"load.force", 2}, {"stack.link_mass", 1e-3});
  for (int k = 1; k <= 3; k++) {
    ZpActuatorDef one = zp_def_member(&def, k);
    ck_assert_double_eq(one.load.force, k == 3 ? 2 : 0);
    ck_assert_double_eq(one.load.mass, k == 3 ? def.load.mass : 1e-3);
  }
  def = DEF({"stack.parallel", 4}, {"load.force", 2}, {"load.mass", 8e-3}, {"member_2.ribbon.thickness", 60e-6});
  for (int k = 1; k <= 4; k++) {
    ZpActuatorDef one = zp_def_member(&def, k);
    ck_assert_double_eq(one.load.force, 0.5);
    ck_assert_double_eq(one.load.mass, 2e-3);
    ck_assert_double_eq(one.ribbon.thickness, k == 2 ? 60e-6 : def.ribbon.thickness);
  }
  static const double pi = 3.14159265358979323846;
  def = DEF({"stack.series", 2}, {"stack.distance", 0.03}, {"stack.voltage_ratio", 2}, {"drive.voltage", 3e3},
            {"drive.waveform", ZP_WAVEFORM_SINE}, {"drive.offset", 1e3});
  for (int turned = 0; turned < 2; turned++) {
    def.mount.tilt = turned ? pi : 0;
    ZpActuatorDef lower = zp_def_member(&def, 2);
    ck_assert_double_eq(zp_def_member(&def, 1).mount.tilt, def.mount.tilt);
    ck_near(lower.mount.tilt + (turned ? pi : 0), pi, 1e-15);
    ck_assert(lower.drive.voltage == 6e3 && lower.drive.offset == 2e3 && lower.load.mass == 0);
  }
}

/* Both insulators lie between the metals. */
TEST(test_insulation_is_of_both) {
  ZpActuatorDef def = DEF({"insulator.thickness", 100e-6});
  ck_assert_double_eq(zp_insulation(&def), 200e-6);
  def.lower.insulator.thickness = 160e-6;
  ck_near(zp_insulation(&def), 260e-6, 1e-15);
  def.lower.insulator.thickness = 0;
  ck_assert_double_eq(zp_insulation(&def), 100e-6);
}

/* auto: of motion what the mesh is worth, eq. (18.13), between 1e-4 and an upper bound; of derivatives less; at rest a
 * thousandth of what is given, or of 1e-4. */
TEST(test_tolerances) {
  ZpActuatorDef dry = DEF({"mesh.nodes", 201}), wet = DEF({"mesh.nodes", 201}, {"liquid.model", ZP_LIQUID_SUBMERGED});
  ck_near(zp_def_tolerance(&dry), 5. / (200 * 200), 1e-12);
  ck_assert_double_eq(zp_def_tolerance(&wet), 1e-4);
  dry.mesh.nodes = wet.mesh.nodes = 101;
  ck_near(zp_def_tolerance(&dry), 5. / (100 * 100), 1e-12);
  ck_near(zp_def_tolerance(&wet), 1.5 / (100 * 100), 1e-12);
  dry.mesh.nodes = wet.mesh.nodes = 9;
  ck_assert_double_eq(zp_def_tolerance(&dry), 1.5e-3);
  ck_assert_double_eq(zp_def_tolerance(&wet), 1e-3);
  ck_near(zp_tolerance_at_rest(&dry), 1e-7, 1e-12);
  strcpy(dry.sensitivity.by, "load.mass");
  ck_assert_double_eq(zp_def_tolerance(&dry), 2.5e-5);
  dry.solver.tolerance = 3e-5;
  ck_assert_double_eq(zp_def_tolerance(&dry), 3e-5);
  ck_near(zp_tolerance_at_rest(&dry), 3e-8, 1e-12);
}

/* -- save and restore ------------------------------------------------------------------------------ */

/* Zipping with drag, contacts, a held force (paper-code) and with a platform that has met or not. */
static ZpActuatorDef saved_def(int which) {
  return which == 0 ? DEF({"mesh.nodes", 21}, {"damping.drag", 0.1})
                    : DEF({"mesh.nodes", 21}, {"preset", ZP_PRESET_PAPER_CODE});
}

TESTS(test_restore_goes_on_bit_for_bit, 0, 2) {
  static const double before[] = {20e-3, 33e-3}, after[] = {50e-3, 45e-3};
  ZpActuatorDef def = saved_def(_i);
  ZpModel *model = model_of(&def);
  ZpSim *sim = sim_of(model), *other = sim_of(model);
  size_t size = zp_sim_state_size(sim);
  char *saved = memory_of(size), *once = memory_of(size), *again = memory_of(size);
  ck_assert_int_eq(zp_sim_run(sim, before[_i], false, NULL, NULL), ZP_REACHED_END);
  double zipped = zp_sim_get(sim, "zipped_length");
  zp_sim_save(sim, saved);
  ck_assert_int_eq(zp_sim_run(sim, after[_i], false, NULL, NULL), ZP_REACHED_END);
  zp_sim_save(sim, once);
  ck_assert_int_ne(memcmp(saved, once, size), 0);
  ck_assert_double_gt(zp_sim_get(sim, "zipped_length"), zipped);
  ck_assert_int_eq(zp_sim_restore(sim, saved, size, NULL), ZP_OK);
  zp_sim_run(sim, after[_i], false, NULL, NULL);
  zp_sim_save(sim, again);
  ck_assert_mem_eq(once, again, size);
  ck_assert_int_eq(zp_sim_restore(other, saved, size, NULL), ZP_OK); /* and in another simulation */
  zp_sim_run(other, after[_i], false, NULL, NULL);
  zp_sim_save(other, again);
  ck_assert_mem_eq(once, again, size);
  ZpError err;
  ck_assert_int_eq(zp_sim_restore(sim, saved, size - 1, &err), ZP_BAD_INPUT);
}

/* A simulation resumes from its saved bytes; damaged ones and those of another actuator are refused. */
TEST(test_saved_state) {
  ZpActuatorDef def = saved_def(0);
  ZpModel *model = model_of(&def);
  def.load.mass *= 2;
  ZpSim *sim = sim_of(model), *again = sim_of(model), *other = sim_of(model_of(&def));
  size_t size = zp_sim_state_size(sim);
  char *saved = memory_of(size), *restored = memory_of(size);
  ck_assert_int_eq(zp_sim_run(sim, 5e-3, false, NULL, NULL), ZP_REACHED_END);
  zp_sim_save(sim, saved);
  ck_assert_int_eq(zp_sim_restore(again, saved, size, NULL), ZP_OK);
  zp_sim_save(again, restored);
  ck_assert_mem_eq(saved, restored, size);
  ck_assert_int_eq(zp_sim_restore(other, saved, size, NULL), ZP_BAD_INPUT);
  ck_assert_int_eq(zp_sim_restore(again, saved, size - 1, NULL), ZP_BAD_INPUT);
  ck_assert_int_eq(zp_sim_restore(again, saved, 0, NULL), ZP_BAD_INPUT);
  for (size_t i = 0; i < size; i++) {
    saved[i] ^= 1;
    ck_assert_int_eq(zp_sim_restore(again, saved, size, NULL), ZP_BAD_INPUT);
    saved[i] ^= 1;
  }
}

/* Reading signals, shapes and recording change nothing. */
TEST(test_looking_changes_nothing) {
  ZpActuatorDef def = saved_def(0);
  ZpModel *model = model_of(&def);
  ZpSim *plain = sim_of(model), *watched = sim_of(model);
  size_t columns, size = zp_sim_state_size(plain);
  const ZpColumn *column = zp_signal_columns(&columns);
  ZpTable *series = zp_table_create(column, columns, 16);
  ZpShapes *film = zp_shapes_create(2, 21, 16);
  zp_sim_record(watched, series, film);
  zp_sim_run(plain, 20e-3, false, NULL, NULL);
  zp_sim_run(watched, 20e-3, false, NULL, NULL);
  char *one = memory_of(size), *two = memory_of(size);
  zp_sim_save(plain, one);
  zp_sim_save(watched, two);
  ck_assert_mem_eq(one, two, size);
  ck_assert_double_eq(zp_sim_get(watched, "stroke"), zp_table_get(series, series->rows - 1, "stroke_m"));
  ck_assert_double_eq(zp_shapes_get(film, film->frames - 1).time, 20e-3);
  ck_assert(isnan(zp_sim_get(plain, "no such signal")));
  zp_sim_shape(watched);
  zp_sim_save(watched, two);
  ck_assert_mem_eq(one, two, size);
  zp_table_destroy(series);
  zp_shapes_destroy(film);
}
