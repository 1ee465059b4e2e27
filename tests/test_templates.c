/* Templates of pictures: those built in are those of plots/, a folder of the user's takes the place of some, a script
 * needs none of them, and what is wrong in one is said with its file and line. */
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "data_util.h"
#include "io/drawing.h"

static char base[1024], notices[8192];

static void set_up(void) {
  ck_assert_ptr_nonnull(getcwd(base, sizeof base - 32));
  strcat(base, "/templates-XXXXXX");
  ck_assert_ptr_nonnull(mkdtemp(base));
  notices[0] = 0;
}

/* Run a command of the shell in `base` => its exit status. */
static int shell(const char *command) {
  char line[4096];
  snprintf(line, sizeof line, "cd '%s' && %s", base, command);
  const int status = system(line);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

static void tear_down(void) {
  ck_assert_int_eq(shell("rm -rf \"$PWD\""), 0);
}

AROUND_EACH(set_up, tear_down)

/* A test that draws, where gnuplot is. */
#define DRAWN_TEST(name) TESTS(name, 0, system("command -v gnuplot >/dev/null") == 0)

static void note(const char *message) {
  const size_t used = strlen(notices);
  snprintf(notices + used, sizeof notices - used, "%s\n", message);
}

/* "base/name", to be freed. */
static char *in_base(const char *name) {
  char *path;
  ck_assert_int_gt(asprintf(&path, "%s/%s", base, name), 0);
  return zp_test_owns(path, free);
}

static void put_file(const char *name, const char *text) {
  char *path = in_base(name);
  write_file(path, text);
}

/* The whole text of base/name, to be freed; NULL if there is none. */
static char *text_of(const char *name) {
  char *path = in_base(name), *text = NULL;
  size_t room = 0;
  FILE *file = fopen(path, "r");
  if (file && getdelim(&text, &room, 0, file) < 0) ck_abort_msg("%s is empty", path);
  if (file) fclose(file);
  return zp_test_owns(text, free);
}

static bool says(const char *name, const char *words) {
  char *text = text_of(name);
  ck_assert_msg(text != NULL, "no %s; %s", name, notices);
  return strstr(text, words) != NULL;
}

/* Draw one shape at rest into base/out, with the templates of base/mine where `own` says so. */
static void draw(bool own) {
  ZpError err = {0};
  ZpActuatorDef def = {0};
  ZpScenario *scenario =
      scenario_with((const char *const[]){"study=stationary", "mesh.nodes=15", "output.errors=false", NULL});
  char *folder = in_base("mine"), *out = in_base("out");
  ck_assert_int_eq(zp_scenario_def(scenario, 0, &def, &err), ZP_OK);
  ZpResult *result = study_of(zp_scenario_study(scenario), &def);
  const ZpReport report = {
      .directory = out, .scenario = scenario, .result = &result, .count = 1, .templates = own ? folder : NULL};
  notices[0] = 0;
  ck_ok(zp_report_write(&report, note, &err));
}

/* Write the built-in templates to base/mine. */
static void write_mine(void) {
  char *folder = in_base("mine");
  ck_ok(zp_templates_write(folder, &err));
}

TEST(built_in_are_those_of_the_repository) {
  write_mine();
  ck_assert_int_eq(shell("diff -r mine " ZP_SOURCE_DIR "/plots >&2"), 0);
}

/* What a user has edited is not written over. */
TEST(files_that_are_there_stay) {
  write_mine();
  put_file("mine/bode.gp", "# mine\n");
  char *folder = in_base("mine");
  ck_says(zp_templates_write(folder, &err), ZP_BAD_INPUT, "exists already");
  ck_assert(says("mine/bode.gp", "# mine"));
}

DRAWN_TEST(an_edited_template_changes_the_picture) {
  write_mine();
  draw(false);
  ck_assert_int_eq(shell("cp out/plots/shape.svg before.svg"), 0);
  draw(true);
  ck_assert_int_eq(shell("cmp out/plots/shape.svg before.svg"), 0); /* the same templates, the same picture */
  ck_assert_int_eq(shell("sed -i \"s/Shape at rest/How it hangs/\" mine/shape.gp"), 0);
  draw(true);
  ck_assert_str_eq(notices, "");
  ck_assert(says("out/plots/shape.svg", "How it hangs") && !says("out/plots/shape.svg", "Shape at rest"));
  ck_assert(says("before.svg", "Shape at rest"));
}

/* One file in the folder is enough, and what all pictures load counts for all. */
DRAWN_TEST(a_shared_template_alone) {
  ck_assert_int_eq(shell("mkdir mine && sed 's/#dddddd/#12abef/' " ZP_SOURCE_DIR "/plots/style.gp >mine/style.gp"), 0);
  draw(true);
  ck_assert_str_eq(notices, "");
  ck_assert(says("out/plots/shape.svg", "rgb( 18, 171, 239)") && says("out/plots/shape.svg", "Shape at rest"));
}

/* A template may load another one that is the user's alone. */
DRAWN_TEST(a_template_of_ones_own) {
  ck_assert_int_eq(
      shell("mkdir mine && { echo \"load 'hello.gp'\"; cat " ZP_SOURCE_DIR "/plots/shape.gp; } >mine/shape.gp"), 0);
  put_file("mine/hello.gp", "set label 77 'hello' at screen 0.5,0.5");
  draw(true);
  ck_assert_str_eq(notices, "");
  ck_assert(says("out/plots/shape.svg", "hello"));
}

DRAWN_TEST(a_script_needs_no_template) {
  write_mine();
  draw(true);
  ck_assert_int_eq(
      shell("rm -r mine && cd out/plots && mv shape.svg drawn.svg && gnuplot shape.gp && cmp shape.svg drawn.svg"), 0);
  ck_assert_int_eq(shell("cd out/plots && gnuplot -e \"out = 'other.svg'\" shape.gp && cmp other.svg drawn.svg"), 0);
}

/* Draw with a template that ends in `line`; what is said of it is `words`, with its file and the number of the line. */
static void check_complaint(const char *line, const char *words) {
  char command[1024], expected[2048];
  snprintf(command, sizeof command,
           "mkdir -p mine && { cat " ZP_SOURCE_DIR
           "/plots/shape.gp; echo \"%s\"; } >mine/shape.gp && wc -l <mine/shape.gp "
           ">lines",
           line);
  ck_assert_int_eq(shell(command), 0);
  char *lines = text_of("lines");
  draw(true);
  snprintf(expected, sizeof expected, "out/plots/shape.svg was not drawn: template %s/mine/shape.gp, line %d: %s", base,
           atoi(lines), words);
  ck_assert_msg(strstr(notices, expected) != NULL, "%s, not %s", notices, expected);
}

DRAWN_TEST(errors_name_file_and_line) {
  check_complaint("set no_such_setting", "Unrecognized option");
  check_complaint("print stroke_m + nothing_of_that_name", "undefined variable: nothing_of_that_name");
}

/* Of what a template loads, too; and behind it the template's own lines count on. */
DRAWN_TEST(errors_in_what_is_loaded) {
  ck_assert_int_eq(shell("mkdir mine && { cat " ZP_SOURCE_DIR "/plots/style.gp; echo 'print lost'; } >mine/style.gp"),
                   0);
  draw(true);
  ck_assert_ptr_nonnull(strstr(notices, "/mine/style.gp, line "));
  ck_assert_ptr_nonnull(strstr(notices, ": undefined variable: lost"));
  ck_assert_ptr_null(strstr(notices, "shape.gp, line"));
}

DRAWN_TEST(templates_in_a_circle) {
  ck_assert_int_eq(shell("mkdir mine"), 0);
  put_file("mine/shape.gp", "load 'shape.gp'\n");
  draw(true);
  ck_assert_ptr_nonnull(strstr(notices, "shape.svg was not drawn: "));
}

/* gnuplot runs templates as programs: a scenario, which may be a stranger's, cannot name them. */
TEST(no_scenario_names_templates) {
  static const char text[] = "output: {templates: mine}\n";
  ZpScenario *scenario = new_scenario();
  ck_says(zp_scenario_set(scenario, "output.templates=mine", &err), ZP_BAD_INPUT,
          "no scenario can name them; use --templates FOLDER");
  ck_says(zp_scenario_parse(scenario, text, strlen(text), "stranger.yaml", &err), ZP_BAD_INPUT,
          "no scenario can name them; use --templates FOLDER");
}

/* The label of each axis has a unit, or says that there is none. A template writes it by label() or as "time / ms". */
TEST(axes_have_units) {
  static const char *const set[] = {"\nset xlabel ", "\nset ylabel ", "\nset cblabel ", "\n  set xlabel ",
                                    "\n  set ylabel "};
  static const char *const variable[] = {"xlabel\n", "x_label\n", "y_label ",
                                         "name(colour_axis) "}; /* made by label() */
  for (const ZpTemplate *one = zp_templates; one->name; one++)
    for (size_t i = 0; i < sizeof set / sizeof set[0]; i++)
      for (const char *at = one->text; (at = strstr(at, set[i])) != NULL; at++) {
        const char *text = at + strlen(set[i]);
        char line[256];
        snprintf(line, sizeof line, "%.*s\n", (int)strcspn(text, "\n"), text);
        bool has = strstr(line, "label(") || strstr(line, " / ") || strstr(line, "'number of");
        for (size_t k = 0; k < sizeof variable / sizeof variable[0]; k++)
          has |= strncmp(line, variable[k], strlen(variable[k])) == 0;
        ck_assert_msg(has, "%s: %s", one->name, line);
      }
}

/* Each picture has its template, and each template loads only what there is. */
TEST(what_templates_load) {
  for (const ZpTemplate *one = zp_templates; one->name; one++)
    for (const char *at = one->text; (at = strstr(at, "load '")) != NULL; at++) {
      char name[64];
      bool found = false;
      ck_assert_int_eq(sscanf(at, "load '%63[^']'", name), 1);
      for (const ZpTemplate *other = zp_templates; other->name && !found; other++)
        found = strcmp(other->name, name) == 0;
      ck_assert_msg(found, "%s loads %s", one->name, name);
    }
}
