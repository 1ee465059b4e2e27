/* A scenario and the kit => an FMU. */
#include <zipact/fmu.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <zipact/version.h>

#include "base/fail.h"
#include "fmu/instance.h"
#include "fmupack/archive.h"
#include "fmupack/description.h"
#include "io/drive_table.h"
#include "io/file.h"
#include "io/number.h"

static const double step_size = 1e-3; /* s, of the default experiment */
enum { MOST_STEPS = 1000 };           /* of it */

/* How far builds of the sources may be that contract products and sums: such a one (gcc -O2 -march=native, with a bead,
 * 20 ms) was off by 1.5e-4 of the largest value of a column, by 0.013 of axial_energy, which vibrates, and by 0.02 of
 * energy_imbalance, a sum of rounding errors. */
#define EXPECTED_TOLERANCE "1e-3 of the largest value of each column, 0.1 of axial_energy, none of energy_imbalance"

/* -- what it begins with --------------------------------------------------------------------------- */

/* Two FNV-1a hashes of the version and of all values, in the form of a GUID. */
static void make_token(const ZpFmuStart *start, char token[ZP_FMU_TOKEN_SIZE]) {
  uint64_t sum[2] = {UINT64_C(0xcbf29ce484222325), UINT64_C(0x9e3779b97f4a7c15)};
  const unsigned char *byte = (const unsigned char *)start->value;
  const size_t size = sizeof *start - offsetof(ZpFmuStart, value); /* values, keys of a network, names */
  for (int k = 0; k < 2; k++) {
    for (const char *c = ZP_VERSION; *c; c++)
      sum[k] = (sum[k] ^ (unsigned char)*c) * UINT64_C(0x100000001b3);
    for (size_t i = 0; i < size; i++)
      sum[k] = (sum[k] ^ byte[i]) * UINT64_C(0x100000001b3);
  }
  snprintf(token, ZP_FMU_TOKEN_SIZE, "{%08x-%04x-%04x-%04x-%012llx}", (unsigned)(sum[0] >> 32),
           (unsigned)(sum[0] >> 16) & 0xFFFF, (unsigned)sum[0] & 0xFFFF, (unsigned)(sum[1] >> 48),
           (unsigned long long)(sum[1] & UINT64_C(0xFFFFFFFFFFFF)));
}

static ZpStatus check(const ZpScenario *scenario, int version, const ZpActuatorDef *def, ZpError *err) {
  if (zp_def_members(def) > 1 && !zp_def_network(def))
    return zp_fail(err, ZP_BAD_INPUT,
                   "a stack of %d members: an FMU contains a single actuator or a network; give bodies and members",
                   zp_def_members(def));
  if (zp_def_members(def) > ZP_FMU_MEMBERS || zp_instance_count(def, ZP_OF_BODY) > ZP_FMU_MEMBERS)
    return zp_fail(err, ZP_BAD_INPUT, "an FMU has at most %d members and %d bodies", ZP_FMU_MEMBERS, ZP_FMU_MEMBERS);
  if (version != 2 && version != 3) return zp_fail(err, ZP_BAD_INPUT, "FMI %d is not supported; use 2 or 3", version);
  if (zp_scenario_count(scenario) != 1)
    return zp_fail(err, ZP_BAD_INPUT, "the scenario has a list of values, but an FMU contains a single actuator");
  if (def->initial.state == ZP_INITIAL_CHECKPOINT)
    return zp_fail(err, ZP_BAD_INPUT,
                   "initial.state = checkpoint: an FMU starts from equilibrium or straight; set any other state in the "
                   "importing tool");
  return ZP_OK;
}

/* An FMU plays no waveform and reads no file of one: its importer sets the input. */
static ZpStatus forget_waveforms(ZpActuatorDef *def, ZpError *err) {
  ZpDriveRows rows = {0};
  ZpStatus status = zp_def_takes_table(def) ? zp_drive_rows_read(def, &rows, err) : ZP_OK;
  const ZpDriveTable table = zp_drive_rows_table(&rows);
  if (status == ZP_OK) zp_fmu_forget_waveforms(def, &table);
  zp_drive_rows_free(&rows);
  return status;
}

/* Keys of segments, members, bodies, springs and joints, and their names. */
static ZpStatus fill_network(const ZpActuatorDef *def, ZpFmuStart *start, ZpError *err) {
  const size_t names = def->given ? def->given->names : 0;
  size_t givens = 0;
  for (int key = zp_def_next_key(def, -1); key >= 0; key = zp_def_next_key(def, key)) {
    if (key < ZP_KEYS) continue;
    if (givens < ZP_FMU_GIVEN) start->given[givens] = (ZpAssignment){key, zp_def_get(def, key)};
    givens++;
  }
  if (givens > ZP_FMU_GIVEN || names > ZP_FMU_NAMES)
    return zp_fail(err, ZP_BAD_INPUT,
                   "%zu keys of segments, members and bodies, %zu names: an FMU has at most %d and %d", givens, names,
                   ZP_FMU_GIVEN, ZP_FMU_NAMES);
  start->givens = givens;
  start->names = names;
  for (size_t k = 0; k < names; k++)
    start->name[k] = def->given->name[k];
  return ZP_OK;
}

static ZpStatus fill_start(ZpActuatorDef *def, ZpFmuStart *start, ZpError *err) {
  memset(start, 0, sizeof *start);
  ZpStatus status = forget_waveforms(def, err);
  if (status == ZP_OK) status = zp_def_forget_ports(def, err);
  if (status != ZP_OK) return status;
  if (zp_fmu_first(def, ZP_INPUT_VOLTAGE) < 0 &&
      zp_instance_given(def, zp_key_find("segment_K.curvature_per_volt")) < 0)
    return zp_fail(err, ZP_BAD_INPUT,
                   "drive.offset: the voltage is %g V at t = 0, where the input of an FMU starts; it takes 0 V or more",
                   zp_fmu_first(def, ZP_INPUT_VOLTAGE));
  def->solver.tolerance = zp_def_tolerance(def); /* importers need a number */
  memcpy(start->mark, ZP_FMU_MARK, ZP_FMU_MARK_SIZE);
  start->size = sizeof *start;
  start->layout = zp_fmu_keys_mark();
  for (int key = 0; key < ZP_KEYS; key++)
    if (zp_fmu_has_number(key)) start->value[key] = zp_def_get(def, key);
  status = fill_network(def, start, err);
  make_token(start, start->token);
  return status;
}

/* -- files of text --------------------------------------------------------------------------------- */

static void put_row(FILE *file, const ZpFmu *fmu) {
  char text[ZP_NUMBER_SIZE];
  zp_number_print(fmu->time, text, sizeof text);
  fputs(text, file);
  for (int k = 0; k < zp_fmu_outputs(&fmu->def); k++) {
    if (!zp_fmu_is_output(k)) continue;
    zp_number_print(fmu->row[k], text, sizeof text);
    fprintf(file, ",%s", isnan(fmu->row[k]) ? "" : text);
  }
  fputc('\n', file);
}

/* The outputs of the default experiment with the inputs at their start values. */
static ZpStatus put_expected(const void *of, FILE *file, ZpError *err) {
  const ZpFmuPlan *plan = of;
  ZpFmu *fmu;
  ZpFmuStep step = {false, false};
  ZpStatus status = zp_fmu_create(plan->start, &fmu, err);
  if (status != ZP_OK) return status;
  fputs("time", file);
  for (int k = 0; k < zp_fmu_outputs(plan->def); k++)
    if (zp_fmu_is_output(k)) fprintf(file, ",%s", zp_fmu_text(plan->def, (ZpFmuVariable){ZP_FMU_OUTPUT, k}).name);
  fputc('\n', file);
  status = zp_fmu_prepare(fmu, err);
  if (status == ZP_OK) put_row(file, fmu);
  for (int k = 1; k * plan->step <= plan->end * (1 + 1e-9) && status == ZP_OK && !step.terminate; k++) {
    status = zp_fmu_step(fmu, k * plan->step, false, &step, err);
    if (status == ZP_OK) put_row(file, fmu);
  }
  fputs("# tolerance: " EXPECTED_TOLERANCE "\n", file);
  zp_fmu_destroy(fmu);
  return status;
}

static ZpStatus put_page(const void *of, FILE *file, ZpError *err) {
  const ZpFmuPlan *plan = of;
  (void)err;
  fputs("<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>", file);
  zp_html_text(file, plan->name);
  fputs("</title></head><body>\n<h1>", file);
  zp_html_text(file, plan->name);
  fputs("</h1>\n<p>Simulated by zipact " ZP_VERSION ": ", file);
  if (zp_def_network(plan->def))
    fputs("electrostatic zipping actuators between bodies. Each channel has an input for its voltage or its setpoint, "
          "each body inputs for a force and a torque.",
          file);
  else
    fprintf(file,
            "an electrostatic zipping actuator. The input <code>%s</code> drives it, the input <code>load</code> pulls "
            "at it.",
            zp_input_name(plan->def->control.kind != ZP_CONTROL_NONE ? ZP_INPUT_SETPOINT : ZP_INPUT_VOLTAGE));
  fputs(" Outputs are the signals, parameters the keys of zipact; modelDescription.xml has a line about each. All "
        "numbers are SI.</p>\n"
        "<p>Voltages and setpoints start at the values that the scenario's waveforms have at t = 0; the waveforms are "
        "not played.</p>\n"
        "<p><a href=\"expected.csv\">expected.csv</a> has the outputs of the default experiment. The binaries compute "
        "them to the last bit, other builds of the sources to the tolerance in its last line.</p>\n</body></html>\n",
        file);
  return ZP_OK;
}

/* The start values as a source, which replaces that of the kit. */
static ZpStatus put_start_source(const void *plan, FILE *file, ZpError *err) {
  const ZpFmuStart *start = ((const ZpFmuPlan *)plan)->start;
  (void)err;
  char text[ZP_NUMBER_SIZE];
  fprintf(file,
          "/* Start values of this FMU. */\n#include <math.h>\n\n#include \"fmu/start.h\"\n\n"
          "const volatile ZpFmuStart zp_fmu_start = {\n  .mark = ZP_FMU_MARK,\n  .size = sizeof(ZpFmuStart),\n  "
          ".layout = UINT64_C(%llu),\n"
          "  .token = \"%s\",\n  .value = {\n",
          (unsigned long long)start->layout, start->token);
  for (int key = 0; key < ZP_KEYS; key++) {
    zp_number_print(start->value[key], text, sizeof text);
    fprintf(file, "    /* %s */ %s,\n", zp_key(key)->name, isnan(start->value[key]) ? "NAN" : text);
  }
  fprintf(file, "  },\n  .givens = %llu,\n  .names = %llu,\n  .given = {{0}", (unsigned long long)start->givens,
          (unsigned long long)start->names);
  for (size_t k = 0; k < start->givens; k++) {
    zp_number_print(start->given[k].value, text, sizeof text);
    fprintf(file, ",\n    [%zu] = {%d, %s}", k, start->given[k].key, isnan(start->given[k].value) ? "NAN" : text);
  }
  fputs("},\n  .name = {{0}", file);
  for (size_t k = 0; k < start->names; k++)
    fprintf(file, ",\n    [%zu] = {%d, %d, \"%s\"}", k, start->name[k].kind, start->name[k].number,
            start->name[k].text);
  fputs("}};\n", file);
  return ZP_OK;
}

static ZpStatus add_text(ZpArchive *archive, const char *name, ZpPut put, const ZpFmuPlan *plan, ZpError *err) {
  char *text;
  size_t size;
  ZpStatus status = zp_text_put(put, plan, &text, &size, err);
  return status == ZP_OK ? zp_archive_add(archive, name, text, size, err) : status;
}

static ZpStatus add_texts(ZpArchive *archive, const ZpFmuPlan *plan, ZpError *err) {
  static const struct {
    const char *name;
    ZpPut put;
    int least; /* version of FMI */
  } text[] = {{"modelDescription.xml", zp_fmu_describe, 2},
              {"documentation/expected.csv", put_expected, 2},
              {"documentation/index.html", put_page, 2},
              {"sources/buildDescription.xml", zp_fmu_describe_build, 3},
              {"terminalsAndIcons/terminalsAndIcons.xml", zp_fmu_describe_terminals, 3}};
  ZpStatus status = ZP_OK;
  for (size_t k = 0; k < sizeof text / sizeof text[0] && status == ZP_OK; k++)
    if (plan->version >= text[k].least) status = add_text(archive, text[k].name, text[k].put, plan, err);
  return status;
}

/* -- files of the kit ------------------------------------------------------------------------------ */

/* Write the start values at the mark in a binary. */
static ZpStatus fill_binary(const char *name, unsigned char *byte, size_t size, const ZpFmuStart *start, ZpError *err) {
  int marks = 0;
  for (size_t k = 0; k + sizeof *start <= size; k++) {
    uint64_t room;
    if (memcmp(byte + k, ZP_FMU_MARK, ZP_FMU_MARK_SIZE) != 0) continue;
    memcpy(&room, byte + k + offsetof(ZpFmuStart, size), sizeof room);
    if (room != sizeof *start)
      return zp_fail(err, ZP_MACHINE, "%.300s: a binary of another version of zipact; build it again with `make fmu`",
                     name);
    memcpy(byte + k, start, sizeof *start);
    marks++;
  }
  if (marks == 1) return ZP_OK;
  return zp_fail(err, ZP_MACHINE, "%.300s: not a binary of this version's kit: it has %d marks, not 1", name, marks);
}

/* (name in the kit, where platforms have the names of FMI 3) => name in the archive, to be freed */
static char *archive_name(const char *name, int version) {
  static const char *const platform[][2] = {{"binaries/x86_64-linux/", "binaries/linux64/"},
                                            {"binaries/x86_64-windows/", "binaries/win64/"}};
  char *text = NULL;
  size_t k = 0, count = version == 2 ? sizeof platform / sizeof platform[0] : 0;
  while (k < count && strncmp(name, platform[k][0], strlen(platform[k][0])) != 0)
    k++;
  if (k == count) return strdup(name);
  return asprintf(&text, "%s%s", platform[k][1], name + strlen(platform[k][0])) < 0 ? NULL : text;
}

static ZpStatus add_file(ZpArchive *archive, const ZpFmuPlan *plan, const char *kit, const char *name, ZpError *err) {
  char *bytes = NULL;
  size_t size;
  if (strcmp(name, "sources/fmu/export/start_block.c") == 0)
    return add_text(archive, name, put_start_source, plan, err);
  char *path = zp_path_join(kit, name), *called = archive_name(name, plan->version);
  ZpStatus status = path && called ? zp_file_read(path, SIZE_MAX / 2, &bytes, &size, err) : zp_fail_memory(err);
  if (status == ZP_OK && strncmp(name, "binaries/", 9) == 0)
    status = fill_binary(name, (unsigned char *)bytes, size, plan->start, err);
  if (status == ZP_OK)
    status = zp_archive_add(archive, called, bytes, size, err);
  else
    free(bytes);
  free(path);
  free(called);
  return status;
}

/* -- the FMU --------------------------------------------------------------------------------------- */

static ZpStatus write_archive(const ZpFmuPlan *plan, const char *kit, const char *path, ZpError *err) {
  ZpArchive *archive;
  ZpStatus status = zp_archive_open(path, &archive, err);
  if (status != ZP_OK) return status;
  status = add_texts(archive, plan, err);
  for (size_t k = 0; k < plan->sources->count && status == ZP_OK; k++)
    status = add_file(archive, plan, kit, plan->sources->item[k], err);
  return zp_archive_close(archive, status, err);
}

/* The files of the kit. ZP_MACHINE if it is not a kit. */
static ZpStatus look_into(const char *kit, ZpKit *names, ZpError *err) {
  ZpStatus status = zp_kit_list(kit, names, err);
  if (status != ZP_OK) return status;
  for (size_t k = 0; k < names->count; k++)
    if (strncmp(names->item[k], "binaries/", 9) == 0) return ZP_OK;
  return zp_fail(err, ZP_MACHINE, "%.300s: not a kit for FMUs: it has no binaries", kit);
}

/* (path) => the name of the file without its extension, to be freed */
static char *model_name(const char *path) {
  const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path, *dot = strrchr(name, '.');
  return dot && dot > name ? strndup(name, (size_t)(dot - name)) : strdup(name);
}

ZpStatus zp_fmu_write(const ZpScenario *scenario, int version, const char *kit, const char *path, ZpError *err) {
  ZpActuatorDef def = {0};
  ZpFmuStart *start = calloc(1, sizeof *start);
  ZpKit names = {NULL, 0};
  ZpStatus status = start ? ZP_OK : zp_fail_memory(err);
  if (status == ZP_OK) status = zp_scenario_def(scenario, 0, &def, err);
  if (status == ZP_OK) status = check(scenario, version, &def, err);
  if (status == ZP_OK) status = look_into(kit, &names, err);
  if (status == ZP_OK) status = fill_start(&def, start, err);
  char *name = status == ZP_OK ? model_name(path) : NULL;
  if (status == ZP_OK && !name) status = zp_fail_memory(err);
  if (status == ZP_OK) {
    const double end = fmin(def.solver.end_time, MOST_STEPS * step_size);
    const ZpFmuPlan plan = {.version = version,
                            .name = name,
                            .start = start,
                            .def = &def,
                            .end = end,
                            .step = fmin(step_size, end),
                            .tolerance = def.solver.tolerance,
                            .sources = &names};
    status = write_archive(&plan, kit, path, err);
  }
  zp_def_clear(&def);
  free(start);
  free(name);
  zp_kit_free(&names);
  return status;
}
