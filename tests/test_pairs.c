/* Every feature of features.def with every other, on a small actuator with a coarse mesh: a pair is refused by a
 * sentence that names both, and stands in tests/data/refused_pairs.tsv, or it balances. At rest the forces are minus
 * the gradient of the energy, and the stiffness is the derivative of the forces. In motion energy, charge and power
 * balance, a restored run continues to the same bits, and a whole or doubled actuator does as its parts do. Two routes
 * to a number at rest agree. */
#include <float.h>

#include "state_util.h"

#include <zipact/calibrate.h>
#include <zipact/io.h>
#include <zipact/trace.h>

#include "def/device.h"
#include "rest/rest.h"
#include "study/studies.h"

/* -- features and pairs ---------------------------------------------------------------------------- */

typedef struct Feature {
  const char *name, *settings;
} Feature;

static const Feature features[] = {
#define ZP_FEATURE(name, settings) {name, settings},
#include "features.def"
};
enum { FEATURES = LENGTH_OF(features), NONE = -1, MOST_SETTINGS = 24, MOST_WORDS = 128 };

/* A key with its value: a number, or a text. */
typedef struct Given {
  int key;
  double value;
  char text[MOST_WORDS];
} Given;

typedef struct Givens {
  Given given[MOST_SETTINGS];
  size_t count;
} Givens;

/* All pairs start from this. */
static const char base[] = "mesh.nodes=9; liquid.model=none; output.errors=false; solver.end_time=30 ms; "
                           "output.samples=200; output.shapes=2";

/* What a study needs in addition, unless a feature says otherwise. */
static const char *needs_of(ZpStudy study) {
  switch (study) {
  case ZP_STUDY_CYCLE:
    return "drive.waveform=sine; drive.frequency=100 Hz; cycle.most_cycles=3";
  case ZP_STUDY_ISOMETRIC:
    return "isometric.separation=8 mm; drive.voltage=6 kV";
  case ZP_STUDY_MODES:
    return "modes.voltage=1 kV";
  case ZP_STUDY_PROFILE:
    return "profile.member=1";
  default:
    return "";
  }
}

static Given *find(Givens *all, int key) {
  for (size_t i = 0; i < all->count; i++)
    if (all->given[i].key == key) return &all->given[i];
  return NULL;
}

/* Add `key=value; key=value` to `all`, in place of earlier values. */
static void give(Givens *all, const char *settings) {
  char copy[512], *rest = copy, *one;
  ck_assert_uint_lt(strlen(settings), sizeof copy);
  strcpy(copy, settings);
  while ((one = strsep(&rest, ";"))) {
    one += strspn(one, " ");
    char *equals = strchr(one, '=');
    if (!equals) continue;
    *equals = 0;
    int key = zp_key_find(one);
    ck_assert_msg(key >= 0, "no key %s", one);
    Given *to = find(all, key);
    if (!to) to = &all->given[all->count++];
    ck_assert_uint_le(all->count, MOST_SETTINGS);
    to->key = key;
    ck_assert_uint_lt(strlen(equals + 1), sizeof to->text);
    strcpy(to->text, equals + 1);
    ZpError err = {ZP_OK, ""};
    if (zp_key(key)->type != ZP_KEY_TEXT)
      ck_assert_msg(zp_value_parse(key, to->text, &to->value, &err) == ZP_OK, "%s", err.message);
  }
}

/* Those of each feature, read once: main. */
static Givens parsed[FEATURES], of_all, of_study[ZpStudy_COUNT];

static void add(Givens *all, const Givens *more) {
  for (size_t i = 0; i < more->count; i++) {
    Given *to = find(all, more->given[i].key);
    if (!to) to = &all->given[all->count++];
    ck_assert_uint_le(all->count, MOST_SETTINGS);
    *to = more->given[i];
  }
}

/* Do they give a key different values? */
static bool are_alternatives(int a, int b) {
  for (size_t i = 0; i < parsed[b].count; i++) {
    const Given *same = find(&parsed[a], parsed[b].given[i].key);
    if (same && strcmp(same->text, parsed[b].given[i].text) != 0) return true;
  }
  return false;
}

/* Do so with each pair of feature `a` and a later one, and with the feature alone; of the pairs with one in `thinned`.
 * By hand: of those with the feature that ZP_PAIR names. */
static void for_pairs(int a, int thinned, void (*check)(int a, int b, const char *name)) {
  const char *with = getenv("ZP_PAIR");
  for (int b = a; b < FEATURES; b++) {
    char name[128];
    if (are_alternatives(a, b) || (a != b && (a + b) % thinned != 0)) continue;
    if (with && strcmp(features[a].name, with) != 0 && strcmp(features[b].name, with) != 0) continue;
    snprintf(name, sizeof name, "%s, %s", features[a].name, features[b].name);
    check(a, b, name);
  }
}

/* (features a and b, or one twice: it alone, or NONE) => a Def for a study, not yet checked. */
static ZpStatus fill(ZpStudy study, int a, int b, ZpActuatorDef *def, ZpError *err) {
  Givens all = {.count = 0};
  add(&all, &of_all);
  add(&all, &of_study[study]);
  if (a != NONE) add(&all, &parsed[a]);
  if (b != NONE) add(&all, &parsed[b]);
  ZpAssignment list[MOST_SETTINGS];
  size_t count = 0;
  for (size_t i = 0; i < all.count; i++)
    if (zp_key(all.given[i].key)->type != ZP_KEY_TEXT)
      list[count++] = (ZpAssignment){all.given[i].key, all.given[i].value};
  ZpStatus status = zp_def_resolve(def, list, count, err);
  lend_members(def);
  for (size_t i = 0; i < all.count && status == ZP_OK; i++)
    if (zp_key(all.given[i].key)->type == ZP_KEY_TEXT)
      status = zp_def_set_text(def, all.given[i].key, all.given[i].text, err);
  return status;
}

/* -- refused pairs --------------------------------------------------------------------------------- */

static const ZpStudy studies[] = {ZP_STUDY_ACTUATE, ZP_STUDY_STATIONARY, ZP_STUDY_EQUILIBRIUM, ZP_STUDY_LIMITS,
                                  ZP_STUDY_MODES,   ZP_STUDY_ISOMETRIC,  ZP_STUDY_CYCLE,       ZP_STUDY_PROFILE};
enum { STUDIES = LENGTH_OF(studies) };

/* Does this study take the pair? If so `def` is its Def. */
static bool takes(ZpStudy study, int a, int b, ZpActuatorDef *def, ZpError *err) {
  return fill(study, a, b, def, err) == ZP_OK && zp_study_check(study, def, err) == ZP_OK;
}

/* Does a message name a key that the feature changes, also by a preset or a supply? */
static bool is_named(const char *message, ZpStudy study, int feature) {
  ZpActuatorDef with = {0}, without = {0};
  fill(study, feature, feature, &with, NULL);
  fill(study, NONE, NONE, &without, NULL);
  for (int key = zp_key_next_field(-1); key >= 0; key = zp_key_next_field(key)) {
    const ZpKey *k = zp_key(key);
    if (!zp_key_in_def(key) || !strstr(message, ZP_KEY_NAME(key))) continue;
    double value = zp_def_get(&with, key), plain = zp_def_get(&without, key);
    bool text = k->type == ZP_KEY_TEXT, changed = !text && value != plain && !(isnan(value) && isnan(plain));
    if (changed || find(&parsed[feature], key)) return true;
  }
  return false;
}

/* Pairs that a study takes one by one, and those of them that it refuses, by the class of the rule; the last one: of a
 * check that is no rule. */
enum { CLASSES = 4 };
typedef struct Shares {
  int cases, refused[CLASSES];
} Shares;
static Shares shares[STUDIES];

static const char *class_word(int class) {
  static const char *const word[CLASSES] = {"physics", "equation", "not modelled", "numbers"};
  return word[class];
}

/* The paper's numerics, whose pairs are counted apart. */
static bool is_of_paper(int feature) {
  static const char *const names[] = {"mass and spring", "soft axial springs", "sequential contact", "Bezier surface",
                                      "paper-text",      "paper-code",         "explicit steps"};
  for (size_t k = 0; k < LENGTH_OF(names); k++)
    if (strcmp(features[feature].name, names[k]) == 0) return true;
  return false;
}

/* How often each rule refuses a pair with a study, without the paper's numerics. */
enum { MOST_RULES = 256 };
static struct {
  const ZpRule *rule;
  int cases;
} costs[MOST_RULES];

static void count_cost(const ZpRule *rule) {
  size_t k = 0;
  while (costs[k].rule && costs[k].rule != rule)
    k++;
  ck_assert_uint_lt(k, MOST_RULES - 1);
  costs[k].rule = rule;
  costs[k].cases++;
}

/* (class, rule) of a refusal in words. */
static void write_rule(FILE *file, const ZpRule *rule, const char *between) {
  char when[128], needs[128];
  zp_condition_text(&rule->when, when, sizeof when);
  zp_condition_text(&rule->needs, needs, sizeof needs);
  fprintf(file, "%s%s%s: %s", class_word((int)rule->class), between, when, needs);
}

/* The shares of each study, without the paper's numerics. */
static void write_shares(FILE *file) {
  for (size_t k = 0; k < STUDIES; k++) {
    fprintf(file, "%s, %d pairs that it takes one by one", zp_study_name(studies[k]), shares[k].cases);
    for (int c = 0; c < CLASSES; c++)
      fprintf(file, ", %s %.1f %%", class_word(c), 100.0 * shares[k].refused[c] / shares[k].cases);
    fprintf(file, "\n");
  }
  for (size_t k = 0; costs[k].rule; k++) {
    printf("%d cases: ", costs[k].cases);
    write_rule(stdout, costs[k].rule, ", ");
    printf("\n");
  }
}

/* Tell the pair (or the feature alone) that some studies refuse, with the first reason. => number of studies */
static int list_refusal(FILE *file, int a, int b, bool alone[FEATURES][STUDIES]) {
  const ZpRule *first = NULL;
  char words[128] = "", reason[sizeof((ZpError *)0)->message] = "";
  int refused = 0;
  for (size_t k = 0; k < STUDIES; k++) {
    ZpActuatorDef def = {0};
    ZpError err = {ZP_OK, ""};
    if (a != b && !(alone[a][k] && alone[b][k])) continue;
    bool counts = a != b && !is_of_paper(a) && !is_of_paper(b);
    shares[k].cases += counts;
    if (takes(studies[k], a, b, &def, &err)) continue;
    const ZpRule *rule = zp_study_refusing(studies[k], &def);
    if (counts && rule) count_cost(rule);
    if (counts) shares[k].refused[rule ? (int)rule->class : CLASSES - 1]++;
    if (refused == 0) first = rule;
    ck_assert_int_eq(err.status, ZP_BAD_INPUT);
    ck_assert_msg(is_named(err.message, studies[k], a) && is_named(err.message, studies[k], b),
                  "%s with %s is refused by %s without the name of both: %s", features[a].name, features[b].name,
                  zp_study_name(studies[k]), err.message);
    if (refused++ == 0) strcpy(reason, err.message);
    snprintf(words + strlen(words), sizeof words - strlen(words), "%s%s", refused > 1 ? " " : "",
             zp_study_name(studies[k]));
  }
  if (refused == 0) return 0;
  fprintf(file, "%s\t%s\t%s", features[a].name, a == b ? "" : features[b].name, words);
  fprintf(file, "\t");
  if (first)
    write_rule(file, first, "\t");
  else
    fprintf(file, "%s\t", class_word(CLASSES - 1));
  fprintf(file, "\t%s\n", reason);
  return refused;
}

/* Are two files the same? */
static bool same_files(const char *a, const char *b) {
  FILE *file[] = {fopen(a, "r"), fopen(b, "r")};
  int byte[2] = {0, 0};
  if (!file[0] || !file[1]) return false;
  do {
    byte[0] = getc(file[0]);
    byte[1] = getc(file[1]);
  } while (byte[0] == byte[1] && byte[0] != EOF);
  fclose(file[0]);
  fclose(file[1]);
  return byte[0] == byte[1];
}

/* The list is tests/data/refused_pairs.tsv: features that a study refuses, alone or together, the studies, and of the
 * first of them the class of the rule, the rule and the message. */
TEST(refused_pairs_are_listed) {
  static const char fresh[] = "refused_pairs.tsv", kept[] = ZP_SOURCE_DIR "/tests/data/refused_pairs.tsv";
  bool alone[FEATURES][STUDIES];
  FILE *file = fopen(fresh, "w");
  ck_assert_ptr_nonnull(file);
  int pairs = 0, refused = 0, cases = 0, refused_cases = 0;
  for (int a = 0; a < FEATURES; a++)
    for (size_t k = 0; k < STUDIES; k++) {
      ZpActuatorDef def = {0};
      alone[a][k] = takes(studies[k], a, a, &def, NULL);
    }
  for (int a = 0; a < FEATURES; a++)
    for (int b = a; b < FEATURES; b++) {
      if (are_alternatives(a, b)) continue;
      int by = list_refusal(file, a, b, alone);
      for (size_t k = 0; a != b && k < STUDIES; k++)
        cases += alone[a][k] && alone[b][k];
      if (a != b) pairs++, refused += by > 0, refused_cases += by;
    }
  write_shares(file);
  fprintf(file, "%d features, %d pairs: %d refused by a study that takes both alone; %d of %d pairs with a study\n",
          FEATURES, pairs, refused, refused_cases, cases);
  ck_assert_int_eq(fclose(file), 0);
  printf("%d features, %d pairs, %d refused; %d of %d pairs with a study\n", FEATURES, pairs, refused, refused_cases,
         cases);
  ck_assert_msg(same_files(fresh, kept), "refused pairs have changed: compare %s with %s, and replace it", fresh, kept);
}

/* Does a simulation of a Def that names no study start? It is refused by a sentence otherwise. */
static bool starts(const ZpActuatorDef *def, const char *name) {
  ZpModel *model = NULL;
  ZpSim *sim = NULL;
  ZpError err = {ZP_OK, ""};
  ZpStatus status = zp_model_create(def, &model, &err);
  if (status == ZP_OK) status = zp_sim_create(model, NULL, &sim, &err);
  zp_sim_destroy(sim);
  zp_model_destroy(model);
  if (status == ZP_OK) return true;
  ck_assert_msg(status == ZP_BAD_INPUT, "%s: status %d, %s", name, (int)status, err.message);
  ck_assert_msg(strchr(err.message, ' ') && strchr(err.message, '.'), "%s: no sentence: %s", name, err.message);
  return false;
}

/* A program may begin motion with a Def that only suits a study at rest: with a pair, and with contact of the paper
 * beside whatever integrator the pair has. What study actuate refuses does not start. */
static void check_start(int a, int b, const char *name) {
  for (int paper = 0; paper <= 1; paper++) {
    ZpActuatorDef def = {0};
    if (fill(ZP_STUDY_STATIONARY, a, b, &def, NULL) != ZP_OK) continue;
    if (paper) def.contact.model = ZP_CONTACT_SEQUENTIAL;
    *def.sensitivity.by = 0; /* of studies alone */
    if (zp_study_check(ZP_STUDY_ACTUATE, &def, NULL) == ZP_OK) continue;
    ck_assert_msg(!starts(&def, name), "%s: study actuate refuses what starts to move", name);
  }
}

/* -- the page of rules ------------------------------------------------------------------------------ */

static void write_rules(FILE *page, const char *owner, const ZpRules *rules) {
  for (size_t i = 0; i < rules->count; i++) {
    const ZpRule *rule = &rules->rule[i];
    char when[128], also[128], needs[128];
    zp_condition_text(&rule->when, when, sizeof when);
    zp_condition_text(&rule->also, also, sizeof also);
    zp_condition_text(&rule->needs, needs, sizeof needs);
    bool bare = rule->when.test == ZP_TEST_ANY, never = rule->needs.test == ZP_TEST_NEVER;
    fprintf(page, "| %s%s | %s%s%s | %s | %s | %s |\n", owner, rule->in_motion ? ", in motion" : "",
            bare ? "always" : when, *also ? ", " : "", also, never ? "(refused)" : needs, class_word((int)rule->class),
            rule->why);
  }
}

static void write_owner(FILE *page, const char *owner, const ZpRules *const *of) {
  for (; *of; of++)
    write_rules(page, owner, *of);
}

/* docs/rules.md is what this writes. */
TEST(page_of_rules_is_current) {
  static const char fresh[] = "rules.md", kept[] = ZP_SOURCE_DIR "/docs/rules.md";
  FILE *page = fopen(fresh, "w");
  ck_assert_ptr_nonnull(page);
  fprintf(page,
          "# Rules\n\nCombinations of keys that are refused, made from the program's own tables. Class `physics`: "
          "the combination has no meaning. Class `equation`: an equation is missing, which the reason names. Class "
          "`not modelled`: the equations are known, and the program does not have them.\n\n"
          "| owner | if | requires | class | reason |\n|---|---|---|---|---|\n");
#define ZP_TERM(name) write_rules(page, #name, &zp_term_##name.rules);
#include "term/terms.def"
#undef ZP_TERM
#define ZP_OWNER(name)                                                                                                 \
  if (strcmp(#name, "terms") != 0) write_owner(page, #name, zp_rules_of_##name);
#include "def/rules.def"
#undef ZP_OWNER
#define ZP_STUDY(enumerator, word, shows, files, help) write_rules(page, "study " #word, &zp_rules_##word);
#include <zipact/studies.def>
  ck_assert_int_eq(fclose(page), 0);
  ck_assert_msg(same_files(fresh, kept), "rules have changed: replace %s by %s", kept, fresh);
}

/* -- forces at rest -------------------------------------------------------------------------------- */

/* Laws of the field, whose forces have a common energy; the others have one each. */
static bool is_electric(const ZpTerm *term) {
  static const char *const names[] = {"plates", "leak", "bezier", "field", "bead"};
  for (size_t k = 0; k < LENGTH_OF(names); k++)
    if (strcmp(term->name, names[k]) == 0) return true;
  return false;
}

/* Laws that have an energy in motion only. */
static bool moves(const ZpTerm *term) {
  return strcmp(term->name, "film") == 0 || strcmp(term->name, "outer") == 0;
}

static double energy_of(const ZpModel *model, const ZpTerm *term, const ZpSpan *now, ZpEval *e) {
  double row[ZP_ROWS_OF_TERM] = {0}, stored = 0;
  term->now(model, now, e, row);
  for (size_t k = 0; k < ZP_ROWS_OF_TERM && term->row[k]; k++)
    if (term->row[k]->kind == ZP_ROW_STORED) stored += row[k];
  return stored;
}

/* Where the beads of each member end, m. */
typedef double Reaches[ZP_MOST_MEMBERS][ZP_BEADS];

/* The law `which` of one member, or all electric ones if it is the number of terms: energy and forces F at the present
 * point. Without suction the forces do no work on the liquid: the energy is that with the liquid where `held` says. */
static double energy_and_forces(ZpStatics *s, size_t member, size_t which, const double *held, double *F) {
  const ZpModel *model = s->member[member].model;
  ZpEval *e = &s->member[member].eval;
  ZpSpan now = zp_span_at(s->member[member].q);
  now.U0 = now.U1 = zp_statics_member_voltage(s, member);
  now.faces_pass = true;
  now.beyond = zp_eval_beyond(e);
  zp_system_force(model, &now, e, F); /* finds edges and gaps for the terms */
  memset(F, 0, 2 * model->stride * sizeof *F);
  double stored = 0;
  ZpElectric field = {0};
  for (size_t k = 0; k < model->laws; k++) {
    const ZpTerm *term = model->law[k].term;
    if (which == model->laws ? !is_electric(term) : k != which) continue;
    term->force(model, &now, e, F);
    if (held && model->has_bead && model->bead.suction == 0) zp_eval_cover(model, held, e);
    if (term->now && !moves(term)) stored += energy_of(model, term, &now, e);
    if (term->electric) term->electric(model, &now, e, ZP_SPAN_END, now.U1, &field);
  }
  double surfaces = 0;
  for (int half = 0; which == model->laws && half < zp_beads(&model->film); half++)
    surfaces -= 2 * model->bead.suction * model->bead.tension * model->film.w * e->reach[half];
  return stored + field.potential + surfaces;
}

enum { ROOM = 2048 };

/* The energy of all members by this law, and their forces by equations => r [n]. NULL: the liquid is where it is. */
static double energy_of_all(ZpStatics *s, size_t which, Reaches held, double *r) {
  double F[ROOM], sum = 0;
  memset(r, 0, s->n * sizeof *r);
  for (size_t k = 0; k < s->members; k++) {
    sum += energy_and_forces(s, k, which, held ? held[k] : NULL, F);
    zp_assembly_add(&s->member[k].assembly, F, r);
  }
  return sum;
}

/* From a saved point by a part of a step of the equations. */
static void move_from(ZpStatics *s, const double *saved, const double *step, double part) {
  zp_statics_branch(s, ZP_ALONG_VOLTAGE).restore(s, saved);
  for (size_t which = 0; which < s->members; which++) {
    ZpRestMember *m = &s->member[which];
    for (size_t k = 0; k < 2 * m->model->count; k++)
      m->q[k / 2 + (k % 2) * m->model->stride] += part * zp_assembly_change(&m->assembly, step, k);
  }
}

/* A wedge that opens from its clips, noisily. Antagonists open by as much as is left of their distance. */
static void open_wedge(ZpStatics *s) {
  for (size_t which = 0; which < s->members; which++) {
    uint64_t seed = 7;
    const ZpRestMember *m = &s->member[which];
    const ZpTopology *t = &m->model->topology;
    size_t last = t->stations - 1;
    double *y = m->q + m->model->stride;
    for (size_t i = 0; i <= last; i++) {
      double part = (double)i / (double)last;
      if (zp_halves(t) == 2) part = 1 - fabs(2 * part - 1);
      if (m->assembly.equation[2 * zp_lower(t, i) + 1] < 0) continue;
      double way = 50e-6 + (s->opposed ? 0.5 * zp_network_depth(s->model->network) - 50e-6 : 500e-6) * part * part;
      y[zp_lower(t, i)] -= way * (1 + (i == t->platform.first ? 0 : 0.1) * noise(&seed));
    }
  }
}

/* A direction in which all nodes move up and down, and a little to the sides. */
static void draw_direction(ZpStatics *s, double *step) {
  uint64_t seed = 11;
  memset(step, 0, s->n * sizeof *step);
  for (size_t which = 0; which < s->members; which++)
    for (size_t k = 0; k < 2 * s->member->model->count; k++) {
      int row = s->member[which].assembly.equation[k];
      if (row >= 0) step[row] = (k % 2 == 0 ? 1e-3 : 1) * noise(&seed);
    }
}

/* The larger of both; NAN if one is. */
static double larger(double a, double b) {
  return b <= a ? a : b;
}

typedef struct AtRest {
  double gradient, stiffness; /* largest relative differences */
} AtRest;

/* Force along the step against the difference of the energy, over the sum of the forces' sizes along it. */
static double gradient_error(ZpStatics *s, size_t which, const double *saved, const double *step, double h) {
  double r[ROOM], other[ROOM], energy[2];
  Reaches reach;
  ZpStaticSystem system = zp_statics_system(s);
  move_from(s, saved, step, 0);
  if (system.refresh) system.refresh(s);
  energy_of_all(s, which, NULL, r);
  for (size_t k = 0; k < s->members; k++)
    memcpy(reach[k], s->member[k].eval.reach, sizeof reach[k]);
  for (int k = 0; k < 2; k++) {
    move_from(s, saved, step, k ? h : -h);
    if (system.refresh) system.refresh(s);
    energy[k] = energy_of_all(s, which, reach, other);
  }
  double along = 0, size = 0;
  for (size_t i = 0; i < s->n; i++)
    along += r[i] * step[i], size += fabs(r[i] * step[i]);
  return size > DBL_EPSILON * fabs(energy[0]) / h ? fabs(along + (energy[1] - energy[0]) / (2 * h)) / size : 0;
}

/* Stiffness times the step against the difference of the forces, over the largest. The field is held. */
static double stiffness_error(ZpStatics *s, const double *saved, const double *step, double h) {
  double product[ROOM], r[2][ROOM], worst = 0, most = 0;
  ZpStaticSystem system = zp_statics_system(s);
  ZpArrow *K = &((ZpRest *)s)->statics.newton.K;
  for (int k = 0; k < 2; k++) {
    move_from(s, saved, step, k ? h : -h);
    system.residual(s, r[k], NULL);
  }
  move_from(s, saved, step, 0);
  system.residual(s, product, NULL);
  zp_statics_take_tensions(s);
  system.stiffness(s, K, NULL);
  zp_arrow_multiply(K, step, product);
  for (size_t i = 0; i < s->n; i++) {
    worst = fmax(worst, fabs(product[i] + (r[1][i] - r[0][i]) / (2 * h)));
    most = fmax(most, fabs(product[i]));
  }
  return worst / most;
}

/* Does it hold a volume, which takes no energy? */
static bool keeps_volume(const ZpTerm *term) {
  return strcmp(term->name, "pouch") == 0;
}

static void check_point(ZpStatics *s, AtRest *worst) {
  double saved[ROOM], step[ROOM];
  ZpBranchSystem system = zp_statics_branch(s, ZP_ALONG_VOLTAGE);
  ck_assert_uint_le(system.save_size, sizeof saved);
  open_wedge(s);
  s->U = 2e3;
  system.save(s, saved);
  draw_direction(s, step);
  const ZpModel *model = s->member->model;
  const bool yields = model->rod.plastic && zp_pouch_rank(model) > 0; /* its film does here: heat is no potential */
  for (size_t k = 0; k <= model->laws; k++) {
    if (k < model->laws && yields && strcmp(model->law[k].term->name, "rod") == 0) continue;
    if (k < model->laws && (is_electric(model->law[k].term) || keeps_volume(model->law[k].term))) continue;
    worst->gradient = larger(worst->gradient, gradient_error(s, k, saved, step, 2e-8));
  }
  if (zp_pouch_rank(model) > 0) return; /* its stiffness is that where the volume is kept: test_pouch */
  worst->stiffness = larger(worst->stiffness, stiffness_error(s, saved, step, 1e-8));
}

/* Of a pair: forces of the shear springs have no energy; three points an element miss a part of the field beside a
 * meniscus that attracts. */
static double allowed_gradient(const ZpActuatorDef *def) {
  if (def->ribbon.model == ZP_RIBBON_MASS_SPRING) return 1e-4;
  return zp_def_liquid(def) == ZP_LIQUID_BEAD && def->bead.suction > 0 ? 2e-3 : 1e-6;
}

/* All members of the model. */
static void check_at_rest(int a, int b, const char *name) {
  ZpActuatorDef def = {0};
  if (!takes(ZP_STUDY_STATIONARY, a, b, &def, NULL)) return;
  ZpModel *model = model_of(&def);
  AtRest worst = {0, 0};
  ZpRest rest;
  ck_assert(zp_rest_open(&rest, model, NULL, NULL));
  check_point(&rest.statics, &worst);
  zp_rest_close(&rest);
  printf("at rest, %s: gradient %.1e, stiffness %.1e\n", name, worst.gradient, worst.stiffness);
  ck_assert_msg(worst.gradient <= allowed_gradient(&def), "%s: force is off -dU/dq by %.1e", name, worst.gradient);
  ck_assert_msg(worst.stiffness <= 3e-7, "%s: stiffness is off -dF/dq by %.1e", name, worst.stiffness);
  zp_model_destroy(model);
}

/* -- in motion ------------------------------------------------------------------------------------- */

static const double middle = 8e-3, end = 14e-3; /* s: faces have met, of most */

static double at(const ZpTable *series, size_t row, const char *column) {
  return zp_table_get(series, row, column);
}

/* Energy that does not balance over the energy that flows; at least some nJ flow. */
static double energy_error(const ZpTable *series) {
  double flow = fmax(largest_in(series, "electric_work_J"), largest_in(series, "kinetic_energy_J"));
  return largest_in(series, "energy_imbalance_J") / fmax(flow, 1e-9);
}

/* What integrators without an energy, or with held forces, may miss; all others solve an energy-conserving step to
 * Newton's tolerance. Two features miss what the worse one does. */
static double allowed_energy(int a, int b) {
  static const struct {
    const char *name;
    double allowed;
  } of[] = {{"drag", 4e-6},         {"mass and spring", 1e-4}, {"soft axial springs", 1e-3},
            {"field", 1e-2},        {"explicit steps", 2e-3},  {"sequential contact", 5e-3},
            {"Bezier surface", 10}, {"paper-text", 20},        {"paper-code", 2}};
  double most = 1e-6;
  for (size_t k = 0; k < LENGTH_OF(of); k++)
    if (strcmp(features[a].name, of[k].name) == 0 || strcmp(features[b].name, of[k].name) == 0)
      most = fmax(most, of[k].allowed);
  return most;
}

/* Integral of a mean rate over the rows. */
static double integral(const ZpTable *series, const char *column) {
  double sum = 0;
  for (size_t r = 1; r < series->rows; r++)
    sum += at(series, r, column) * (at(series, r, "time_s") - at(series, r - 1, "time_s"));
  return sum;
}

/* Mean current and power against charge and energy, unless charge passes elsewhere; and sums against their parts. */
static double book_error(const ZpTable *series, const ZpActuatorDef *def) {
  double worst = 0, drawn = fmax(largest_in(series, "source_energy_J"), 1e-9), stored[2], energy[2];
  for (size_t r = 0; r < series->rows; r++) {
    double supplied = at(series, r, "electric_work_J") + at(series, r, "cable_energy_J") +
                      at(series, r, "source_loss_J") + at(series, r, "bleeder_loss_J"),
           film = at(series, r, "film_along_loss_J") + at(series, r, "film_across_loss_J");
    worst = larger(worst, fabs(supplied - at(series, r, "source_energy_J")) / drawn);
    worst = larger(worst, fabs(film - at(series, r, "viscous_loss_J")) / drawn);
  }
  for (size_t k = 0; k < 2; k++) {
    size_t row = k * (series->rows - 1);
    stored[k] = at(series, row, "charge_C") + def->source.capacitance * at(series, row, "voltage_V");
    energy[k] = at(series, row, "source_energy_J");
  }
  worst = larger(worst, fabs(integral(series, "power_W") - energy[1] + energy[0]) / drawn);
  bool passes = !isnan(def->source.bleeder) || !isnan(def->insulator.resistivity) || !isnan(def->medium.resistivity);
  double charge = largest_in(series, "charge_C") + def->source.capacitance * largest_in(series, "voltage_V") + 1e-15;
  return passes ? worst : larger(worst, fabs(integral(series, "current_A") - stored[1] + stored[0]) / charge);
}

static ZpSim *start(const ZpActuatorDef *def, ZpModel **model, const char *name) {
  ZpSim *sim = NULL;
  ZpError err = {ZP_OK, ""};
  ck_assert_msg(zp_data_sim_create(def, NULL, model, &sim, &err) == ZP_OK, "%s: %s", name, err.message);
  return sim;
}

/* Is the pair refused where it hangs, by a sentence that names both? */
static bool is_refused_at_rest(const ZpActuatorDef *def, int a, int b, const char *name) {
  ZpModel *model = NULL;
  ZpSim *sim = NULL;
  ZpError err = {ZP_OK, ""};
  ZpStatus status =
      def->control.signal == ZP_CONTROL_CONTRACTION ? zp_data_sim_create(def, NULL, &model, &sim, &err) : ZP_OK;
  zp_sim_destroy(sim);
  zp_model_destroy(model);
  if (status == ZP_OK) return false;
  ck_assert_msg(is_named(err.message, ZP_STUDY_ACTUATE, a) && is_named(err.message, ZP_STUDY_ACTUATE, b),
                "%s is refused without the name of both: %s", name, err.message);
  printf("refused at rest, %s\n", name);
  return true;
}

/* Run to a time => the state there, which the caller frees. */
static void *state_at(ZpSim *sim, double time, const char *name) {
  ZpRunInfo info;
  ck_assert_msg(zp_sim_run(sim, time, false, NULL, &info) == ZP_REACHED_END, "%s: %s", name, info.message);
  void *bytes = calloc(1, zp_sim_state_size(sim));
  zp_sim_save(sim, bytes);
  return bytes;
}

/* A second run to the middle, and a third one that continues from the first one's state there: the same bits. */
static void check_continued(const ZpActuatorDef *def, const void *halfway, const void *finally, const char *name) {
  ZpModel *model = NULL;
  ZpSim *sim = start(def, &model, name);
  size_t size = zp_sim_state_size(sim);
  void *again = state_at(sim, middle, name);
  ck_assert_msg(memcmp(again, halfway, size) == 0, "%s: a second run differs", name);
  ZpModel *same = NULL;
  ZpSim *other = start(def, &same, name);
  ZpError err = {ZP_OK, ""};
  ck_assert_msg(zp_sim_restore(other, halfway, size, &err) == ZP_OK, "%s: %s", name, err.message);
  void *continued = state_at(other, end, name);
  ck_assert_msg(memcmp(continued, finally, size) == 0, "%s: the restored run differs", name);
  free(again), free(continued);
  zp_sim_destroy(sim);
  zp_sim_destroy(other);
  zp_model_destroy(model);
  zp_model_destroy(same);
}

static void check_in_motion(int a, int b, const char *name) {
  ZpActuatorDef def = {0};
  if (!takes(ZP_STUDY_ACTUATE, a, b, &def, NULL) || is_refused_at_rest(&def, a, b, name)) return;
  ZpModel *model = NULL;
  ZpSim *sim = start(&def, &model, name);
  size_t columns;
  const ZpColumn *column = zp_signal_columns(&columns);
  ZpTable *series = zp_table_create(column, columns, 200);
  zp_sim_record(sim, series, NULL);
  void *halfway = state_at(sim, middle, name), *finally = state_at(sim, end, name);
  double energy = energy_error(series), books = book_error(series, &def);
  printf("in motion, %s: energy %.1e, books %.1e, zipped %.1f mm\n", name, energy, books,
         1e3 * zp_sim_get(sim, "zipped_length"));
  ck_assert_msg(energy <= allowed_energy(a, b), "%s: energy is off balance by %.1e", name, energy);
  ck_assert_msg(books <= 3e-13, "%s: a book is off by %.1e", name, books);
  for (size_t i = 0; i < series->rows * series->columns; i++)
    ck_assert_msg(!isinf(series->value[i]), "%s: a signal is infinite", name);
  check_continued(&def, halfway, finally, name);
  free(halfway), free(finally);
  zp_table_destroy(series);
  zp_sim_destroy(sim);
  zp_model_destroy(model);
}

/* -- two halves, and two in parallel ----------------------------------------------------------------- */

static int feature(const char *name) {
  for (int k = 0; k < FEATURES; k++)
    if (strcmp(features[k].name, name) == 0) return k;
  ck_abort_msg("no feature %s", name);
  return NONE;
}

/* Half of an actuator that has all twice: forces, masses and charges are half as large. */
static void halve(ZpActuatorDef *def) {
  static const struct {
    const char *key;
    double factor;
  } of[] = {{"load.force", 0.5},        {"load.stiffness", 0.5},     {"load.stop_stiffness", 0.5},
            {"load.change_mass", 0.5},  {"stack.link_mass", 0.5},    {"source.current_limit", 0.5},
            {"source.sink_limit", 0.5}, {"source.capacitance", 0.5}, {"source.resistance", 2},
            {"source.bleeder", 2},      {"sense.noise", 0.5}};
  for (size_t k = 0; k < LENGTH_OF(of); k++) {
    int key = zp_key_find(of[k].key);
    double value = zp_def_get(def, key);
    if (value != zp_key(key)->def && !isnan(value)) zp_def_set(def, key, of[k].factor * value, NULL);
  }
  def->load.mass *= 0.5;
  if (def->control.kind == ZP_CONTROL_NONE || def->control.signal != ZP_CONTROL_CAPACITANCE) return;
  def->setpoint.value *= 0.5;
  def->setpoint.offset *= 0.5;
  def->control.proportional *= 2;
  def->control.integral *= 2;
}

/* Largest relative difference of what both do in time, where the second one has `times` the size of the first. */
static double motion_difference(const ZpActuatorDef *one, const ZpActuatorDef *many, double times, const char *name) {
  static const struct {
    const char *signal;
    bool grows;
  } of[] = {{"stroke", false},        {"end_velocity", false}, {"charge", true},        {"electric_work", true},
            {"kinetic_energy", true}, {"field_energy", true},  {"internal_loss", true}, {"viscous_loss", true}};
  const ZpActuatorDef *def[] = {one, many};
  double value[2][LENGTH_OF(of)], worst = 0;
  for (int k = 0; k < 2; k++) {
    ZpModel *model = NULL;
    ZpSim *sim = start(def[k], &model, name);
    free(state_at(sim, middle, name));
    for (size_t i = 0; i < LENGTH_OF(of); i++)
      value[k][i] = zp_sim_get(sim, of[i].signal) / (k && of[i].grows ? times : 1);
    zp_sim_destroy(sim);
    zp_model_destroy(model);
  }
  for (size_t i = 0; i < LENGTH_OF(of); i++)
    if (value[0][i] != value[1][i]) worst = larger(worst, fabs(value[1][i] / value[0][i] - 1));
  return worst;
}

/* A feature with another one that makes `times` as much of it. */
static void compare(int a, int other, double times, const char *name) {
  ZpActuatorDef one = {0}, many = {0};
  if (a == other || are_alternatives(a, other) || find(&parsed[a], zp_key_find("stack.parallel"))) return;
  if (!takes(ZP_STUDY_ACTUATE, a, a, &one, NULL) || !takes(ZP_STUDY_ACTUATE, a, other, &many, NULL)) return;
  bool fed = one.source.model == ZP_SOURCE_AMPLIFIER; /* steps differ, because the supply is there once */
  if (fed) one.solver.tolerance = many.solver.tolerance = 1e-5;
  if (times > 1) halve(&one);
  double off = motion_difference(&one, &many, times, name);
  printf("%s, %s: %.1e\n", features[other].name, features[a].name, off);
  ck_assert_msg(off <= (fed ? 2e-4 : 5e-8), "%s, %s: off by %.1e", features[other].name, features[a].name, off);
}

static void check_doubled(int a, int b, const char *name) {
  if (a != b) return;
  compare(a, feature("whole"), 1, name);
  compare(a, feature("equal ones parallel"), 2, name);
}

/* -- studies --------------------------------------------------------------------------------------- */

static ZpResult *run_study(ZpStudy study, const ZpActuatorDef *def, const char *name) {
  ZpResult *result = NULL;
  ZpError err = {ZP_OK, ""};
  ck_assert_msg(zp_data_study_run(study, def, NULL, &result, &err) == ZP_OK, "%s: %s", name, err.message);
  for (size_t i = 0; i < result->scalars; i++)
    ck_assert_msg(!isinf(result->scalar[i].value), "%s: %s is infinite", name, result->scalar[i].name);
  return result;
}

/* Without weight and spring a hinge turns freely: no equilibrium is the one. */
static bool is_neutral(const ZpActuatorDef *def) {
  return def->actuator.kind == ZP_KIND_HINGE && def->hinge.stiffness == 0 && def->gravity == 0;
}

/* The lower antagonist may pull in by its own voltage alone. */
static bool has_answered(const ZpResult *result) {
  bool biased = strstr(result->message, "a member pulls in below its own constant voltage");
  return zp_outcome_good(result->outcome) || result->outcome == ZP_PULLED_IN || biased;
}

/* NULL: the study does not take the pair. The answer may be that there is no hanging equilibrium. Where so coarse a
 * mesh has none, a finer one has. */
static ZpResult *answer(ZpStudy study, int a, int b, const char *name) {
  ZpActuatorDef def = {0};
  if (!takes(study, a, b, &def, NULL) || is_neutral(&def)) return NULL;
  ZpResult *result = run_study(study, &def, name);
  if (!has_answered(result)) {
    def.mesh.nodes = 21;
    zp_result_destroy(result);
    result = run_study(study, &def, name);
  }
  ck_assert_msg(has_answered(result), "%s, %s: %s", zp_study_name(study), name, result->message);
  return result;
}

static double difference(const ZpResult *a, const ZpResult *b, const char *name) {
  double x = zp_result_get(a, name), y = zp_result_get(b, name);
  return x == y || (isnan(x) && isnan(y)) ? 0 : fabs(x / y - 1);
}

/* What the load pulls with at this opening, N: load.share applies to all that hangs there. */
static double pull_at(const ZpActuatorDef *def, double opening) {
  double share = zp_def_has(def, ZP_DEVICE_PLATFORM) ? 2 * def->load.share : def->load.share,
         hung = def->load.mass * def->gravity * cos(def->mount.tilt) + def->load.force, spring = 0, stop = 0;
  if (def->load.stiffness > 0) spring = def->load.stiffness * fmax(def->load.rest_opening - opening, 0);
  if (!isnan(def->load.stop_opening)) stop = def->load.stop_stiffness * fmax(opening - def->load.stop_opening, 0);
  return share * (hung + spring - stop);
}

/* An actuator that is held at the opening at which it hangs needs the force of its load. */
static double hold_error(int a, int b, const ZpResult *hanging, const char *name) {
  ZpActuatorDef def = {0};
  if (!takes(ZP_STUDY_ISOMETRIC, a, b, &def, NULL)) return 0;
  double opening = zp_result_get(hanging, "opening_m");
  def.isometric.separation = zp_def_has(&def, ZP_DEVICE_PLATFORM) ? opening : zp_result_get(hanging, "stroke_m");
  def.drive.voltage = 0;
  if (!(def.isometric.separation > 1e-5) || zp_study_check(ZP_STUDY_ISOMETRIC, &def, NULL) != ZP_OK) return 0;
  ZpResult *held = run_study(ZP_STUDY_ISOMETRIC, &def, name);
  double force = zp_result_get(held, "force_unpowered_N"), pull = pull_at(&def, opening);
  zp_result_destroy(held);
  if (zp_def_has(&def, ZP_DEVICE_POUCH)) return isnan(force) ? 0 : INFINITY; /* its force is not sought */
  return fabs(force - pull) / fmax(fabs(pull), 1e-3);
}

/* Does it follow equilibria along the voltage? */
static bool follows_branch(ZpStudy study) {
  return study == ZP_STUDY_EQUILIBRIUM || study == ZP_STUDY_LIMITS || study == ZP_STUDY_ISOMETRIC;
}

static void check_studies(int a, int b, const char *name) {
  int field = feature("field"), errors = feature("estimated errors"); /* seconds for a branch, and several meshes */
  if (a != b && (a == field || b == field || a == errors || b == errors)) return;
  ZpResult *of[ZpStudy_COUNT] = {NULL};
  for (size_t k = 1; k < STUDIES; k++)
    if (a != field || !follows_branch(studies[k])) of[studies[k]] = answer(studies[k], a, b, name);
  const ZpResult *limits = of[ZP_STUDY_LIMITS], *branch = of[ZP_STUDY_EQUILIBRIUM], *cycle = of[ZP_STUDY_CYCLE];
  static const char *const voltages[] = {"pull_in_voltage_V", "closing_voltage_V", "release_voltage_V"};
  double limit = 0, hold = of[ZP_STUDY_STATIONARY] ? hold_error(a, b, of[ZP_STUDY_STATIONARY], name) : 0;
  for (size_t k = 0; limits && branch && k < LENGTH_OF(voltages); k++)
    limit = larger(limit, difference(limits, branch, voltages[k]));
  ZpActuatorDef def = {0};
  bool sprung = takes(ZP_STUDY_CYCLE, a, b, &def, NULL) && def.ribbon.model == ZP_RIBBON_MASS_SPRING;
  double energy = cycle && cycle->series ? energy_error(cycle->series) : 0;
  double work = of[ZP_STUDY_PROFILE] ? fabs(zp_result_get(of[ZP_STUDY_PROFILE], "virtual_work_difference")) : 0;
  printf("studies, %s: limits %.1e, held %.1e, cycle %.1e, virtual work %.1e\n", name, limit, hold, energy, work);
  ck_assert_msg(limit <= 1e-12, "%s: limits are off the branch by %.1e", name, limit);
  /* 3.4e-10 measured: the unbalanced force that Newton's method leaves may be 1e-9 of the weight */
  ck_assert_msg(hold <= 1e-9, "%s: the held force is off the load by %.1e", name, hold);
  ck_assert_msg(energy <= (sprung ? 20 : 5) * allowed_energy(a, b), "%s: a cycle is off balance by %.1e", name, energy);
  ck_assert_msg(work <= 1e-3, "%s: the force of the field is off virtual work by %.1e", name, work);
  for (int k = 0; k < ZpStudy_COUNT; k++)
    zp_result_destroy(of[k]);
}

static double study_value(ZpStudy study, const ZpActuatorDef *def, int key, double value, const char *output) {
  ZpActuatorDef other = *def;
  *other.sensitivity.by = 0;
  zp_def_set(&other, key, value, NULL);
  ZpResult *result = run_study(study, &other, output);
  double answered = zp_result_get(result, output);
  zp_result_destroy(result);
  return answered;
}

/* Can the key be changed by h either way? Where isometric holds the platform there is no load. */
static bool varies(ZpStudy study, const ZpActuatorDef *def, int key, double h) {
  if (study == ZP_STUDY_ISOMETRIC && strncmp(zp_key(key)->name, "load.", 5) == 0) return false;
  for (int side = -1; side <= 1; side += 2) {
    ZpActuatorDef other = *def;
    bool set = zp_def_set(&other, key, zp_def_get(def, key) + side * h, NULL) == ZP_OK;
    if (!set || zp_study_check(study, &other, NULL) != ZP_OK) return false;
  }
  return h > 0;
}

/* Difference quotient of an answer by a key. */
static double change_by(ZpStudy study, const ZpActuatorDef *def, int key, double h, const char *output) {
  double value = zp_def_get(def, key);
  return (study_value(study, def, key, value + h, output) - study_value(study, def, key, value - h, output)) / (2 * h);
}

/* A derivative that a study gives against the difference of its answers; of frequencies, whose steps have to be wide,
 * with that of twice the step. */
static void check_slope(ZpStudy study, const char *output, int key, const ZpActuatorDef *plain, const char *name) {
  double step = study == ZP_STUDY_MODES ? 2e-3 : 1e-4; /* frequencies are solved to some 1e-9 */
  ZpActuatorDef def = *plain;
  if (zp_def_set_text(&def, zp_key_find("sensitivity.by"), zp_key(key)->name, NULL) != ZP_OK) return;
  double value = zp_key(key)->type == ZP_KEY_TEXT ? NAN : zp_def_get(&def, key), h = step * fabs(value);
  if (!varies(study, &def, key, h)) return;
  ZpResult *result = run_study(study, &def, name);
  bool answered = result->sensitivities > 0;
  double slope = answered ? slope_in(result, output, zp_key(key)->name) : NAN, here = zp_result_get(result, output);
  zp_result_destroy(result);
  if (isnan(slope)) return;
  double change = change_by(study, &def, key, h, output);
  if (study == ZP_STUDY_MODES && varies(study, &def, key, 2 * h)) {
    double finer = (4 * change - change_by(study, &def, key, 2 * h, output)) / 3;
    if (fabs(finer - slope) < fabs(change - slope)) change = finer; /* else there is a kink within twice the step */
  }
  double size = fabs(slope) + 1e-3 * fabs(here / value); /* a derivative that hardly changes the output is rounding */
  double off = size > 0 ? fabs(slope - change) / size : 0;
  printf("derivative of %s by %s, %s: %.9g, off by %.1e\n", output, zp_key(key)->name, name, slope, off);
  ck_assert_msg(off <= 2e-4, "%s: derivative of %s by %s, %.9g, is off by %.1e", name, output, zp_key(key)->name, slope,
                off);
}

/* The derivatives that studies give with each feature: by the load, and by the feature's own keys. */
static void check_derivatives(int a, int b, const char *name) {
  static const struct {
    ZpStudy study;
    const char *output;
  } of[] = {{ZP_STUDY_STATIONARY, "stroke_m"},
            {ZP_STUDY_LIMITS, "pull_in_voltage_V"},
            {ZP_STUDY_ISOMETRIC, "force_N"},
            {ZP_STUDY_MODES, "frequency_1_Hz"}};
  if (a != b || a == feature("derivatives")) return;
  for (size_t k = 0; k < LENGTH_OF(of); k++) {
    ZpActuatorDef def = {0};
    if (!takes(of[k].study, a, a, &def, NULL) || is_neutral(&def)) continue;
    Givens keys = parsed[a];
    give(&keys, "load.mass=8 g");
    for (size_t i = 0; i < keys.count; i++)
      check_slope(of[k].study, of[k].output, keys.given[i].key, &def, name);
  }
}

/* Two measurements, of columns in g or ms and mm, and what study calibrate says of the difference, m; NAN: refused. */
static double residual_of(const ZpActuatorDef *plain, const char *columns, const double set[2], const double stroke[2],
                          const char *name) {
  char text[256];
  snprintf(text, sizeof text, "%s\n%.17g,%.17g\n%.17g,%.17g\n", columns, 1e3 * set[0], 1e3 * stroke[0], 1e3 * set[1],
           1e3 * stroke[1]);
  write_file("pairs-measured.csv", text);
  ZpActuatorDef def = *plain;
  ZpError err = {ZP_OK, ""};
  ck_assert_int_eq(zp_def_set_text(&def, zp_key_find("data.file"), "pairs-measured.csv", NULL), ZP_OK);
  ck_assert_int_eq(zp_def_set_text(&def, zp_key_find("calibrate.fit"), "", NULL), ZP_OK);
  if (zp_study_check(ZP_STUDY_CALIBRATE, &def, &err) != ZP_OK) {
    ck_assert_msg(err.status == ZP_BAD_INPUT && strchr(err.message, ' '), "%s: %s", name, err.message);
    return NAN;
  }
  ZpResult *result = NULL;
  ck_assert_msg(zp_data_study_run(ZP_STUDY_CALIBRATE, &def, NULL, &result, &err) == ZP_OK, "%s: %s", name, err.message);
  double residual = zp_result_get(result, "residual_rms_m");
  zp_result_destroy(result);
  return residual;
}

/* The stroke of a run at two times. */
static void follow_stroke(const ZpActuatorDef *def, const double time[2], double stroke[2], const char *name) {
  static const char *const signal[] = {"stroke"};
  ZpModel *model = NULL;
  ZpTrace *trace = NULL;
  ZpError err;
  zp_sim_destroy(start(def, &model, name));
  ck_assert_msg(zp_trace_create(model, signal, 1, NULL, 0, time[1], NULL, &trace, &err) == ZP_OK, "%s: %s", name,
                err.message);
  for (int k = 0; k < 2; k++)
    stroke[k] = zp_trace_at(trace, 0, time[k]).value;
  zp_trace_destroy(trace);
  zp_model_destroy(model);
}

/* A fit without keys to fit finds no difference to strokes that study stationary and a run in time have. */
static void check_measured(int a, int b, const char *name) {
  ZpActuatorDef def = {0};
  if (a != b || !takes(ZP_STUDY_STATIONARY, a, a, &def, NULL) || is_neutral(&def)) return;
  static const double mass[] = {1e-3, 1.2e-3}, time[] = {4e-3, 8e-3};
  *def.sensitivity.by = 0; /* takes other steps */
  double stroke[2], hung, moved = NAN;
  for (int k = 0; k < 2; k++)
    stroke[k] = study_value(ZP_STUDY_STATIONARY, &def, zp_key_find("load.mass"), mass[k], "stroke_m");
  hung = residual_of(&def, "load_g,stroke_mm", mass, stroke, name);
  if (takes(ZP_STUDY_ACTUATE, a, a, &def, NULL) && !is_refused_at_rest(&def, a, a, name)) {
    if (isnan(def.solver.tolerance)) def.solver.tolerance = 1e-4; /* else a fit finds its own */
    follow_stroke(&def, time, stroke, name);
    moved = residual_of(&def, "time_ms,stroke_mm", time, stroke, name);
  }
  printf("measured, %s: strokes of loads off by %.1e m, of times by %.1e m\n", name, hung, moved);
  ck_assert_msg(!(hung > 1e-17) && !(moved > 1e-17), "%s: off by %g and %g m", name, hung, moved);
}

/* -- all of it ------------------------------------------------------------------------------------- */

/* A part of the pairs in `make check`, all at night. */
#define PAIR_TESTS(test, KIND, check, thinned)                                                                         \
  KIND(test, 0, FEATURES) {                                                                                            \
    for_pairs(_i, thinned, check);                                                                                     \
  }

PAIR_TESTS(some_refused_pairs_do_not_start, TESTS, check_start, 24)
PAIR_TESTS(refused_pairs_do_not_start, NIGHTLY_TESTS, check_start, 1)
PAIR_TESTS(forces_at_rest_of_some_pairs, TESTS, check_at_rest, 12)
PAIR_TESTS(forces_at_rest_of_all_pairs, NIGHTLY_TESTS, check_at_rest, 1)
PAIR_TESTS(motion_of_some_pairs, TESTS, check_in_motion, 24)
PAIR_TESTS(motion_of_all_pairs, NIGHTLY_TESTS, check_in_motion, 1)
PAIR_TESTS(twice_of_each_feature, TESTS, check_doubled, FEATURES)
PAIR_TESTS(studies_of_all_pairs, NIGHTLY_TESTS, check_studies, 1)
PAIR_TESTS(derivatives_of_each_feature, NIGHTLY_TESTS, check_derivatives, FEATURES)
PAIR_TESTS(measurements_of_each_feature, NIGHTLY_TESTS, check_measured, FEATURES)

static void read_features(void) {
  give(&of_all, base);
  for (int k = 0; k < ZpStudy_COUNT; k++)
    give(&of_study[k], needs_of((ZpStudy)k));
  for (int k = 0; k < FEATURES; k++)
    give(&parsed[k], features[k].settings);
}

AROUND_ALL(read_features, NULL)
