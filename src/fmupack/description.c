/* modelDescription.xml and the files beside it. One pass over the variables, in the order inputs, outputs, parameters,
 * serves every part of the file; FMI 2 and FMI 3 differ in wording. */
#include "fmupack/description.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <zipact/version.h>

#include "base/fail.h"
#include "fmu/export/slave.h"
#include "fmu/variables.h"
#include "fmupack/base_units.h"
#include "io/file.h"
#include "io/number.h"
#include "io/units.h"

enum { MOST_VARIABLES = 1 + ZP_FMU_INPUTS + ZP_FMU_OUTPUTS + ZP_KEYS + ZP_FMU_GIVEN };

/* The variables of a plan, in order. */
typedef struct List {
  const ZpActuatorDef *def;
  ZpFmuVariable item[MOST_VARIABLES];
  int count;
} List;

static void list_variables(const ZpFmuPlan *plan, List *list) {
  list->def = plan->def;
  list->count = 0;
  if (plan->version == 3) list->item[list->count++] = (ZpFmuVariable){ZP_FMU_TIME, 0};
  for (int k = zp_def_input_next(plan->def, -1); k >= 0; k = zp_def_input_next(plan->def, k))
    list->item[list->count++] = (ZpFmuVariable){ZP_FMU_INPUT, k};
  for (int k = 0; k < zp_fmu_outputs(plan->def); k++)
    if (zp_fmu_is_output(k)) list->item[list->count++] = (ZpFmuVariable){ZP_FMU_OUTPUT, k};
  for (int k = 0; k < ZP_KEYS; k++)
    if (zp_fmu_is_parameter(k, plan->start->value[k])) list->item[list->count++] = (ZpFmuVariable){ZP_FMU_PARAMETER, k};
  for (size_t k = 0; k < plan->start->givens; k++)
    if (zp_fmu_is_parameter(plan->start->given[k].key, plan->start->given[k].value))
      list->item[list->count++] = (ZpFmuVariable){ZP_FMU_PARAMETER, plan->start->given[k].key};
}

/* -- attributes ------------------------------------------------------------------------------------ */

static void put_text(FILE *file, const char *attribute, const char *text) {
  fprintf(file, " %s=\"", attribute);
  zp_html_text(file, text);
  fputc('"', file);
}

static void put_number(FILE *file, const char *attribute, double value) {
  char text[ZP_NUMBER_SIZE];
  zp_number_print(value, text, sizeof text);
  fprintf(file, " %s=\"%s\"", attribute, text);
}

/* The customary unit, if it differs; otherwise NULL. */
static const char *display_unit(const ZpActuatorDef *def, ZpFmuVariable variable) {
  if (variable.role == ZP_FMU_INPUT && strcmp(zp_fmu_text(def, variable).unit, "V") == 0)
    return zp_key(zp_key_find("drive.voltage"))->shown;
  if (variable.role != ZP_FMU_PARAMETER) return NULL;
  const ZpKey *key = zp_key(variable.index);
  return *key->shown && strcmp(key->shown, key->unit) != 0 ? key->shown : NULL;
}

static bool has_unit(const ZpActuatorDef *def, ZpFmuVariable variable) {
  return zp_fmu_type(variable) == ZP_KEY_REAL && strcmp(zp_fmu_text(def, variable).unit, "1") != 0;
}

/* -- units ----------------------------------------------------------------------------------------- */

static bool same_unit(const ZpActuatorDef *def, ZpFmuVariable a, ZpFmuVariable b) {
  return has_unit(def, a) && has_unit(def, b) && strcmp(zp_fmu_text(def, a).unit, zp_fmu_text(def, b).unit) == 0;
}

static bool same_display(const ZpActuatorDef *def, ZpFmuVariable a, ZpFmuVariable b) {
  const char *one = display_unit(def, a), *other = display_unit(def, b);
  return same_unit(def, a, b) && one && other && strcmp(one, other) == 0;
}

/* Is item k the first with its unit? */
static bool is_first(const List *list, int k, bool (*same)(const ZpActuatorDef *, ZpFmuVariable, ZpFmuVariable)) {
  for (int j = 0; j < k; j++)
    if (same(list->def, list->item[j], list->item[k])) return false;
  return true;
}

static void put_power(FILE *file, const char *symbol, int exponent) {
  if (exponent) fprintf(file, " %s=\"%d\"", symbol, exponent);
}

/* A display unit: its value is factor times that in SI. */
static ZpStatus put_display(FILE *file, const char *shown, const char *unit, ZpError *err) {
  ZpUnitScale scale;
  ZpStatus status = zp_unit_scale(shown, unit, &scale, err);
  if (status != ZP_OK) return status;
  fputs("      <DisplayUnit", file);
  put_text(file, "name", shown);
  if (scale.decimal)
    fprintf(file, " factor=\"1e%d\"", -scale.exponent);
  else
    put_number(file, "factor", 1 / scale.factor);
  fputs("/>\n", file);
  return ZP_OK;
}

static ZpStatus put_unit(FILE *file, const List *list, int first, ZpError *err) {
  ZpBaseUnits powers;
  ZpStatus status = ZP_OK;
  const char *unit = zp_fmu_text(list->def, list->item[first]).unit;
  fputs("    <Unit", file);
  put_text(file, "name", unit);
  fputs(">\n", file);
  if (zp_base_units(unit, &powers)) {
    fputs("      <BaseUnit", file);
    put_power(file, "kg", powers.kg);
    put_power(file, "m", powers.m);
    put_power(file, "s", powers.s);
    put_power(file, "A", powers.A);
    fputs("/>\n", file);
  }
  for (int k = first; k < list->count && status == ZP_OK; k++)
    if (same_unit(list->def, list->item[first], list->item[k]) && display_unit(list->def, list->item[k]) &&
        is_first(list, k, same_display))
      status = put_display(file, display_unit(list->def, list->item[k]), unit, err);
  fputs("    </Unit>\n", file);
  return status;
}

static ZpStatus put_units(FILE *file, const List *list, ZpError *err) {
  ZpStatus status = ZP_OK;
  fputs("  <UnitDefinitions>\n", file);
  for (int k = 0; k < list->count && status == ZP_OK; k++)
    if (has_unit(list->def, list->item[k]) && is_first(list, k, same_unit)) status = put_unit(file, list, k, err);
  fputs("  </UnitDefinitions>\n", file);
  return status;
}

/* -- types ----------------------------------------------------------------------------------------- */

/* The type of a key of words has the name of the key; no variable has that name. */
static void put_type_name(FILE *file, const char *attribute, ZpFmuVariable variable) {
  fprintf(file, " %s=\"words.%s\"", attribute, zp_key(variable.index)->name);
}

static void put_words(FILE *file, const ZpFmuPlan *plan, ZpFmuVariable variable) {
  const ZpKey *key = zp_key(variable.index);
  bool two = plan->version == 2;
  fputs(two ? "    <SimpleType" : "    <EnumerationType", file);
  put_type_name(file, "name", variable);
  fputs(two ? ">\n      <Enumeration>\n" : ">\n", file);
  for (int k = 0; k <= (int)key->max; k++) {
    fputs("        <Item", file);
    put_text(file, "name", key->choices[k].word);
    fprintf(file, " value=\"%d\"", k);
    put_text(file, "description", key->choices[k].help);
    fputs("/>\n", file);
  }
  fputs(two ? "      </Enumeration>\n    </SimpleType>\n" : "    </EnumerationType>\n", file);
}

/* Have both variables the same row of keys? */
static bool same_words(const ZpActuatorDef *def, ZpFmuVariable a, ZpFmuVariable b) {
  (void)def;
  return a.role == ZP_FMU_PARAMETER && b.role == ZP_FMU_PARAMETER && zp_key(a.index) == zp_key(b.index);
}

static void put_types(FILE *file, const ZpFmuPlan *plan, const List *list) {
  fputs("  <TypeDefinitions>\n", file);
  for (int k = 0; k < list->count; k++)
    if (zp_fmu_type(list->item[k]) == ZP_KEY_ENUM && is_first(list, k, same_words))
      put_words(file, plan, list->item[k]);
  fputs("  </TypeDefinitions>\n", file);
}

/* -- variables ------------------------------------------------------------------------------------- */

static void put_causality(FILE *file, const ZpFmuPlan *plan, ZpFmuVariable variable) {
  static const char *const causality[] = {"independent", "input", "output", "parameter"};
  const char *variability = variable.role != ZP_FMU_PARAMETER   ? "continuous"
                            : zp_fmu_is_tunable(variable.index) ? "tunable"
                                                                : "fixed";
  fprintf(file, " causality=\"%s\" variability=\"%s\"", causality[variable.role], variability);
  if (variable.role == ZP_FMU_OUTPUT) fputs(" initial=\"calculated\"", file);
  if (variable.role == ZP_FMU_PARAMETER) fputs(" initial=\"exact\"", file);
  if (variable.role == ZP_FMU_INPUT && plan->version == 3) fputs(" initial=\"exact\"", file);
}

static void put_head(FILE *file, const ZpFmuPlan *plan, ZpFmuVariable variable) {
  put_text(file, "name", zp_fmu_text(plan->def, variable).name);
  fprintf(file, " valueReference=\"%u\"", zp_fmu_reference(variable));
  put_text(file, "description", zp_fmu_text(plan->def, variable).help);
  put_causality(file, plan, variable);
}

/* Unit, range. */
static void put_range(FILE *file, const ZpActuatorDef *def, ZpFmuVariable variable) {
  const char *shown = display_unit(def, variable);
  if (has_unit(def, variable)) put_text(file, "unit", zp_fmu_text(def, variable).unit);
  if (has_unit(def, variable) && shown) put_text(file, "displayUnit", shown);
  if (zp_fmu_type(variable) == ZP_KEY_BOOL || zp_fmu_type(variable) == ZP_KEY_ENUM) return;
  bool voltage = variable.role == ZP_FMU_INPUT && strcmp(zp_fmu_text(def, variable).unit, "V") == 0;
  int key = voltage ? zp_key_find("drive.voltage") : variable.role == ZP_FMU_PARAMETER ? variable.index : -1;
  if (key < 0) return;
  put_number(file, "min", zp_key(key)->min);
  put_number(file, "max", zp_key(key)->max);
}

static void put_start(FILE *file, const ZpFmuPlan *plan, ZpFmuVariable variable) {
  if (variable.role != ZP_FMU_PARAMETER && variable.role != ZP_FMU_INPUT) return;
  double value = variable.role == ZP_FMU_PARAMETER ? zp_def_get(plan->def, variable.index)
                                                   : zp_fmu_first(plan->def, variable.index);
  if (zp_fmu_type(variable) == ZP_KEY_BOOL)
    fprintf(file, " start=\"%s\"", value != 0 ? "true" : "false");
  else
    put_number(file, "start", value);
}

/* The word for its type in the standard. */
static const char *type_word(const ZpFmuPlan *plan, ZpFmuVariable variable) {
  bool two = plan->version == 2;
  switch (zp_fmu_type(variable)) {
  case ZP_KEY_INT:
    return two ? "Integer" : "Int32";
  case ZP_KEY_BOOL:
    return "Boolean";
  case ZP_KEY_ENUM:
    return "Enumeration";
  default:
    return two ? "Real" : "Float64";
  }
}

static void put_variable(FILE *file, const ZpFmuPlan *plan, ZpFmuVariable variable) {
  bool two = plan->version == 2;
  if (two) fputs("    <ScalarVariable", file);
  if (two) put_head(file, plan, variable);
  fprintf(file, "%s<%s", two ? ">\n      " : "    ", type_word(plan, variable));
  if (!two) put_head(file, plan, variable);
  if (zp_fmu_type(variable) == ZP_KEY_ENUM) put_type_name(file, "declaredType", variable);
  put_range(file, plan->def, variable);
  put_start(file, plan, variable);
  fputs(two ? "/>\n    </ScalarVariable>\n" : "/>\n", file);
}

/* The variables on which output k depends at once: as indices of FMI 2, which count from 1, or value references of FMI
 * 3. */
static void put_dependencies(FILE *file, const ZpFmuPlan *plan, const List *list, int k) {
  const char *between = "";
  fputs(" dependencies=\"", file);
  for (int j = 0; j < list->count; j++) {
    ZpFmuVariable input = list->item[j];
    if (input.role != ZP_FMU_INPUT || !zp_fmu_follows(list->def, list->item[k].index, input.index)) continue;
    fprintf(file, "%s%u", between, plan->version == 2 ? (unsigned)j + 1 : zp_fmu_reference(input));
    between = " ";
  }
  fputc('"', file);
}

static void put_outputs(FILE *file, const ZpFmuPlan *plan, const List *list, const char *word, bool dependencies) {
  for (int k = 0; k < list->count; k++) {
    if (list->item[k].role != ZP_FMU_OUTPUT) continue;
    unsigned place = plan->version == 2 ? (unsigned)k + 1 : zp_fmu_reference(list->item[k]);
    fprintf(file, "      <%s %s=\"%u\"", word, plan->version == 2 ? "index" : "valueReference", place);
    if (dependencies) put_dependencies(file, plan, list, k);
    fputs("/>\n", file);
  }
}

/* The initial value of an output depends on all parameters. */
static void put_structure(FILE *file, const ZpFmuPlan *plan, const List *list) {
  bool two = plan->version == 2;
  fputs(two ? "  <ModelStructure>\n    <Outputs>\n" : "  <ModelStructure>\n", file);
  put_outputs(file, plan, list, two ? "Unknown" : "Output", true);
  fputs(two ? "    </Outputs>\n    <InitialUnknowns>\n" : "", file);
  put_outputs(file, plan, list, two ? "Unknown" : "InitialUnknown", false);
  fputs(two ? "    </InitialUnknowns>\n  </ModelStructure>\n" : "  </ModelStructure>\n", file);
}

/* -- the file -------------------------------------------------------------------------------------- */

/* Is this file of the kit a source to compile? => its name below sources/, otherwise NULL. */
static const char *source_name(const char *file) {
  static const char folder[] = "sources/";
  size_t length = strlen(file);
  bool source = strncmp(file, folder, strlen(folder)) == 0 && length > 2 && strcmp(file + length - 2, ".c") == 0;
  return source ? file + strlen(folder) : NULL;
}

static void put_sources(FILE *file, const ZpFmuPlan *plan, const char *word) {
  for (size_t k = 0; k < plan->sources->count; k++) {
    const char *name = source_name(plan->sources->item[k]);
    if (name) fprintf(file, "      <%s name=\"%s\"/>\n", word, name);
  }
}

static void put_root(FILE *file, const ZpFmuPlan *plan) {
  fprintf(file, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<fmiModelDescription fmiVersion=\"%d.0\"", plan->version);
  put_text(file, "modelName", plan->name);
  put_text(file, plan->version == 2 ? "guid" : "instantiationToken", plan->start->token);
  put_text(file, "description",
           zp_def_network(plan->def) ? "Electrostatic zipping actuators between bodies"
                                     : "An electrostatic zipping actuator");
  put_text(file, "version", ZP_VERSION);
  put_text(file, "generationTool", "zipact " ZP_VERSION);
  fprintf(file, " variableNamingConvention=\"structured\"%s>\n",
          plan->version == 2 ? " numberOfEventIndicators=\"0\"" : "");
}

static void put_capabilities(FILE *file, const ZpFmuPlan *plan) {
  fputs("  <CoSimulation modelIdentifier=\"" ZP_FMU_IDENTIFIER "\" canHandleVariableCommunicationStepSize=\"true\"",
        file);
  if (plan->version == 3) {
    fputs(" canGetAndSetFMUState=\"true\" canSerializeFMUState=\"true\" providesDirectionalDerivatives=\"true\""
          " providesAdjointDerivatives=\"true\" mightReturnEarlyFromDoStep=\"true\" hasEventMode=\"true\"/>\n",
          file);
    return;
  }
  fputs(" canInterpolateInputs=\"true\" maxOutputDerivativeOrder=\"0\" canNotUseMemoryManagementFunctions=\"true\""
        " canGetAndSetFMUstate=\"true\" canSerializeFMUstate=\"true\" providesDirectionalDerivative=\"true\">\n"
        "    <SourceFiles>\n",
        file);
  put_sources(file, plan, "File");
  fputs("    </SourceFiles>\n  </CoSimulation>\n", file);
}

static void put_experiment(FILE *file, const ZpFmuPlan *plan) {
  fputs("  <LogCategories>\n"
        "    <Category name=\"" ZP_LOG_EVENTS "\" description=\"events, and deviations from what the importer "
        "requested\"/>\n    <Category name=\"" ZP_LOG_DISCARD
        "\" description=\"refused calls\"/>\n    <Category name=\"" ZP_LOG_ERROR "\" description=\"failures\"/>\n"
        "  </LogCategories>\n"
        "  <DefaultExperiment startTime=\"0\"",
        file);
  put_number(file, "stopTime", plan->end);
  put_number(file, "tolerance", plan->tolerance);
  put_number(file, "stepSize", plan->step);
  fputs("/>\n", file);
}

static ZpStatus describe(const ZpFmuPlan *plan, List *list, FILE *file, ZpError *err) {
  list_variables(plan, list);
  put_root(file, plan);
  put_capabilities(file, plan);
  ZpStatus status = put_units(file, list, err);
  put_types(file, plan, list);
  put_experiment(file, plan);
  fputs("  <ModelVariables>\n", file);
  for (int k = 0; k < list->count; k++)
    put_variable(file, plan, list->item[k]);
  fputs("  </ModelVariables>\n", file);
  put_structure(file, plan, list);
  fputs("</fmiModelDescription>\n", file);
  return status;
}

ZpStatus zp_fmu_describe(const void *of, FILE *file, ZpError *err) {
  List *list = calloc(1, sizeof *list);
  if (!list) return zp_fail_memory(err);
  ZpStatus status = describe(of, list, file, err);
  free(list);
  return status;
}

ZpStatus zp_fmu_describe_build(const void *plan, FILE *file, ZpError *err) {
  (void)err;
  fputs("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<fmiBuildDescription fmiVersion=\"3.0\">\n"
        "  <BuildConfiguration modelIdentifier=\"" ZP_FMU_IDENTIFIER "\">\n"
        "    <SourceFileSet language=\"C99\" compilerOptions=\"-ffp-contract=off -fopenmp-simd\">\n",
        file);
  put_sources(file, plan, "SourceFile");
  fputs("      <IncludeDirectory name=\".\"/>\n    </SourceFileSet>\n"
        "    <Library name=\"m\" external=\"true\"/>\n  </BuildConfiguration>\n</fmiBuildDescription>\n",
        file);
  return ZP_OK;
}

ZpStatus zp_fmu_describe_terminals(const void *of, FILE *file, ZpError *err) {
  const ZpFmuPlan *plan = of;
  (void)err;
  if (zp_def_network(plan->def)) { /* the current is that of all ports together */
    fputs("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<fmiTerminalsAndIcons fmiVersion=\"3.0\">\n"
          "</fmiTerminalsAndIcons>\n",
          file);
    return ZP_OK;
  }
  fprintf(file,
          "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<fmiTerminalsAndIcons fmiVersion=\"3.0\">\n  <Terminals>\n"
          "    <Terminal name=\"electrodes\" matchingRule=\"bus\" description=\"the electrical port: the commanded "
          "voltage of the source, and the mean current over a step\">\n"
          "      <TerminalMemberVariable variableName=\"%s\" memberName=\"v\" variableKind=\"signal\"/>\n"
          "      <TerminalMemberVariable variableName=\"current\" memberName=\"i\" variableKind=\"signal\"/>\n"
          "    </Terminal>\n  </Terminals>\n</fmiTerminalsAndIcons>\n",
          plan->def->control.kind != ZP_CONTROL_NONE ? "command" : "voltage");
  return ZP_OK;
}
