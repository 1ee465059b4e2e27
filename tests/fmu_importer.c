/* An importer of FMUs, on libzip, libxml2 and dlopen. */
#include "fmu_importer.h"

#include <dlfcn.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <check.h>
#include <libxml/parser.h>
#include <libxml/xmlschemas.h>
#include <zip.h>

#ifndef ZP_SOURCE_DIR
#define ZP_SOURCE_DIR "."
#endif

_Thread_local char last_message[MESSAGE];

/* -- unpacking ------------------------------------------------------------------------------------- */

static void make_folders(char *path) {
  for (char *slash = strchr(path + 1, '/'); slash; slash = strchr(slash + 1, '/')) {
    *slash = 0;
    mkdir(path, 0777);
    *slash = '/';
  }
}

static void unpack_file(zip_t *zip, zip_uint64_t index, const char *folder) {
  char path[1024];
  zip_stat_t info;
  ck_assert_int_eq(zip_stat_index(zip, index, 0, &info), 0);
  snprintf(path, sizeof path, "%s/%s", folder, info.name);
  make_folders(path);
  void *bytes = malloc(info.size + 1);
  zip_file_t *in = zip_fopen_index(zip, index, 0);
  ck_assert_int_eq(zip_fread(in, bytes, info.size), (zip_int64_t)info.size);
  zip_fclose(in);
  remove(path); /* a library may be loaded from there */
  FILE *out = fopen(path, "wb");
  ck_assert_ptr_nonnull(out);
  ck_assert_uint_eq(fwrite(bytes, 1, info.size, out), info.size);
  ck_assert_int_eq(fclose(out), 0);
  free(bytes);
}

void fmu_unpack(const char *path, const char *folder) {
  int reason;
  zip_t *zip = zip_open(path, ZIP_RDONLY, &reason);
  ck_assert_msg(zip != NULL, "%s: no archive", path);
  for (zip_int64_t k = 0; k < zip_get_num_entries(zip, 0); k++)
    unpack_file(zip, (zip_uint64_t)k, folder);
  zip_close(zip);
}

/* -- modelDescription.xml -------------------------------------------------------------------------- */

static void validate(xmlDocPtr document, int version) {
  char path[1024];
  snprintf(path, sizeof path, ZP_SOURCE_DIR "/tests/fmi/fmi%dModelDescription.xsd", version);
  xmlSchemaParserCtxtPtr parser = xmlSchemaNewParserCtxt(path);
  xmlSchemaPtr schema = xmlSchemaParse(parser);
  ck_assert_msg(schema != NULL, "%s: no schema", path);
  xmlSchemaValidCtxtPtr check = xmlSchemaNewValidCtxt(schema);
  ck_assert_int_eq(xmlSchemaValidateDoc(check, document), 0);
  xmlSchemaFreeValidCtxt(check);
  xmlSchemaFree(schema);
  xmlSchemaFreeParserCtxt(parser);
}

static void text_of(xmlNodePtr node, const char *attribute, char *text, size_t size) {
  xmlChar *value = xmlGetProp(node, (const xmlChar *)attribute);
  snprintf(text, size, "%s", value ? (const char *)value : "");
  xmlFree(value);
}

static bool number_of(xmlNodePtr node, const char *attribute, double *number) {
  char text[64];
  text_of(node, attribute, text, sizeof text);
  if (!*text) return false;
  *number = strcmp(text, "true") == 0 ? 1 : strcmp(text, "false") == 0 ? 0 : strtod(text, NULL);
  return true;
}

static xmlNodePtr child(xmlNodePtr node, const char *name) {
  for (xmlNodePtr k = node->children; k; k = k->next)
    if (k->type == XML_ELEMENT_NODE && (!name || strcmp((const char *)k->name, name) == 0)) return k;
  return NULL;
}

static Kind kind_of(xmlNodePtr node) {
  const char *name = (const char *)node->name;
  if (strcmp(name, "Boolean") == 0) return KIND_BOOLEAN;
  if (strcmp(name, "Enumeration") == 0) return KIND_ENUMERATION;
  if (strcmp(name, "Integer") == 0 || strcmp(name, "Int32") == 0) return KIND_INTEGER;
  ck_assert_msg(strcmp(name, "Real") == 0 || strcmp(name, "Float64") == 0, "%s", name);
  return KIND_REAL;
}

/* The attributes of FMI 2 stand in two elements, those of FMI 3 in one. */
static Variable variable_of(xmlNodePtr outer, xmlNodePtr inner) {
  char text[1024];
  double reference = -1;
  Variable v = {.kind = kind_of(inner)};
  text_of(outer, "name", v.name, sizeof v.name);
  text_of(outer, "causality", v.causality, sizeof v.causality);
  text_of(outer, "variability", v.variability, sizeof v.variability);
  text_of(outer, "description", text, sizeof text);
  text_of(inner, "unit", v.unit, sizeof v.unit);
  text_of(inner, "displayUnit", v.display, sizeof v.display);
  text_of(inner, "declaredType", v.declared, sizeof v.declared);
  v.description = strlen(text);
  ck_assert(number_of(outer, "valueReference", &reference));
  v.reference = (uint32_t)reference;
  v.has_start = number_of(inner, "start", &v.start);
  v.has_range = number_of(inner, "min", &v.min) && number_of(inner, "max", &v.max);
  return v;
}

static void read_variables(Fmu *fmu, xmlNodePtr root) {
  for (xmlNodePtr k = child(root, "ModelVariables")->children; k; k = k->next) {
    if (k->type != XML_ELEMENT_NODE) continue;
    fmu->variable = realloc(fmu->variable, (fmu->variables + 1) * sizeof *fmu->variable);
    fmu->variable[fmu->variables++] = variable_of(k, fmu->version == 2 ? child(k, NULL) : k);
  }
}

static Unit unit_of(xmlNodePtr node) {
  static const char *const base[BASES] = {"kg", "m", "s", "A"};
  Unit unit = {.shown = 0};
  text_of(node, "name", unit.name, sizeof unit.name);
  for (xmlNodePtr k = node->children; k; k = k->next) {
    if (k->type != XML_ELEMENT_NODE) continue;
    if (strcmp((const char *)k->name, "BaseUnit") == 0) {
      unit.has_base = true;
      for (int b = 0; b < BASES; b++)
        number_of(k, base[b], &unit.power[b]);
    } else {
      ck_assert_uint_lt(unit.shown, SHOWN_MOST);
      text_of(k, "name", unit.display[unit.shown].name, sizeof unit.display->name);
      ck_assert(number_of(k, "factor", &unit.display[unit.shown++].factor));
    }
  }
  return unit;
}

static void read_units(Fmu *fmu, xmlNodePtr root) {
  for (xmlNodePtr k = child(root, "UnitDefinitions")->children; k; k = k->next) {
    if (k->type != XML_ELEMENT_NODE) continue;
    fmu->unit = realloc(fmu->unit, (fmu->units + 1) * sizeof *fmu->unit);
    fmu->unit[fmu->units++] = unit_of(k);
  }
}

static Variable *variable_at(Fmu *fmu, unsigned place) {
  if (fmu->version == 2) return &fmu->variable[place - 1];
  for (size_t k = 0; k < fmu->variables; k++)
    if (fmu->variable[k].reference == place) return &fmu->variable[k];
  ck_abort_msg("no variable %u", place);
}

static void read_dependencies(Fmu *fmu, xmlNodePtr node) {
  char text[64], *end = text;
  double place = 0;
  ck_assert(number_of(node, fmu->version == 2 ? "index" : "valueReference", &place));
  text_of(node, "dependencies", text, sizeof text);
  for (unsigned long input; (input = strtoul(end, &end, 10)) > 0;) {
    const char *name = variable_at(fmu, (unsigned)input)->name;
    variable_at(fmu, (unsigned)place)->follows[strcmp(name, "load") == 0 ? 1 : 0] = true;
  }
}

static void read_structure(Fmu *fmu, xmlNodePtr root) {
  xmlNodePtr list = child(root, "ModelStructure");
  if (fmu->version == 2) list = child(list, "Outputs");
  for (xmlNodePtr k = list->children; k; k = k->next)
    if (k->type == XML_ELEMENT_NODE && strcmp((const char *)k->name, "InitialUnknown") != 0) read_dependencies(fmu, k);
}

static void read_description(Fmu *fmu, char identifier[64]) {
  char path[1024], version[16];
  snprintf(path, sizeof path, "%s/modelDescription.xml", fmu->folder);
  xmlDocPtr document = xmlReadFile(path, NULL, 0);
  ck_assert_msg(document != NULL, "%s: not XML", path);
  xmlNodePtr root = xmlDocGetRootElement(document), experiment = child(root, "DefaultExperiment");
  text_of(root, "fmiVersion", version, sizeof version);
  fmu->version = atoi(version);
  validate(document, fmu->version);
  text_of(root, fmu->version == 2 ? "guid" : "instantiationToken", fmu->token, sizeof fmu->token);
  text_of(child(root, "CoSimulation"), "modelIdentifier", identifier, 64);
  ck_assert(number_of(experiment, "stopTime", &fmu->stop) && number_of(experiment, "stepSize", &fmu->step));
  read_units(fmu, root);
  read_variables(fmu, root);
  read_structure(fmu, root);
  xmlFreeDoc(document);
}

Fmu fmu_open(const char *folder) {
  Fmu fmu = {0};
  char library[1024], identifier[64];
  snprintf(fmu.folder, sizeof fmu.folder, "%s", folder);
  read_description(&fmu, identifier);
  snprintf(library, sizeof library, "%s/binaries/%s/%s.so", folder, fmu.version == 2 ? "linux64" : "x86_64-linux",
           identifier);
  fmu.library = dlopen(library, RTLD_NOW | RTLD_LOCAL);
  ck_assert_msg(fmu.library != NULL, "%s", dlerror());
  return fmu;
}

void fmu_close(Fmu *fmu) {
  free(fmu->variable);
  free(fmu->unit);
  dlclose(fmu->library);
}

const Variable *fmu_find(const Fmu *fmu, const char *name) {
  for (size_t k = 0; k < fmu->variables; k++)
    if (strcmp(fmu->variable[k].name, name) == 0) return &fmu->variable[k];
  ck_abort_msg("no variable %s", name);
}

/* -- calls ----------------------------------------------------------------------------------------- */

void *fmu_function(const Fmu *fmu, const char *name) {
  char whole[64];
  snprintf(whole, sizeof whole, "fmi%d%s", fmu->version, name);
  void *function = dlsym(fmu->library, whole);
  ck_assert_msg(function != NULL, "%s is not exported", whole);
  return function;
}

/* Call a function of either version: CALL(instance, DoStep, (arguments of FMI 2), (arguments of FMI 3)). */
#define FUNCTION(fmu, whole, name) ((__typeof__(&whole))fmu_function(fmu, name))
#define CALL2(name, ...)           (int)FUNCTION(instance->fmu, fmi2##name, #name)(instance->handle, ##__VA_ARGS__)
#define CALL3(name, ...)           (int)FUNCTION(instance->fmu, fmi3##name, #name)(instance->handle, ##__VA_ARGS__)

static bool is_two(const Instance *instance) {
  return instance->fmu->version == 2;
}

static void log_of_2(fmi2ComponentEnvironment environment, fmi2String name, fmi2Status status, fmi2String category,
                     fmi2String message, ...) {
  size_t length = 0;
  (void)environment, (void)name, (void)status, (void)category;
  for (const char *c = message; *c && length + 1 < MESSAGE;
       c++) { /* as an importer that cannot read further arguments */
    if (*c == '%') ck_assert_msg(*++c == '%', "a format with arguments: %s", message);
    last_message[length++] = *c;
  }
  last_message[length] = 0;
}

static void log_of_3(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category, fmi3String message) {
  (void)environment, (void)status, (void)category;
  snprintf(last_message, MESSAGE, "%s", message);
}

Instance fmu_instantiate(const Fmu *fmu, const char *token, Steps steps) {
  static const fmi2CallbackFunctions callbacks = {log_of_2, calloc, free, NULL, NULL};
  Instance instance = {fmu, NULL};
  bool events = steps == STEPS_TO_EVENTS;
  if (fmu->version == 2)
    instance.handle = FUNCTION(fmu, fmi2Instantiate, "Instantiate")("arm", fmi2CoSimulation, token, "file:///nowhere",
                                                                    &callbacks, fmi2False, fmi2False);
  else
    instance.handle = FUNCTION(fmu, fmi3InstantiateCoSimulation, "InstantiateCoSimulation")(
        "arm", token, "/nowhere/", false, false, events, events, NULL, 0, NULL, log_of_3, NULL);
  return instance;
}

void *fmu_instantiate_other(const Fmu *fmu, Other other) {
  static const fmi2CallbackFunctions callbacks = {log_of_2, calloc, free, NULL, NULL};
  const fmi3ValueReference any = 1;
  last_message[0] = 0;
  if (fmu->version == 2)
    return FUNCTION(fmu, fmi2Instantiate, "Instantiate")("arm", fmi2ModelExchange, fmu->token, "file:///nowhere",
                                                         &callbacks, fmi2False, fmi2False);
  if (other == OTHER_EXCHANGE)
    return FUNCTION(fmu, fmi3InstantiateModelExchange, "InstantiateModelExchange")("arm", fmu->token, "/nowhere/",
                                                                                   false, false, NULL, log_of_3);
  if (other == OTHER_SCHEDULED)
    return FUNCTION(fmu, fmi3InstantiateScheduledExecution, "InstantiateScheduledExecution")(
        "arm", fmu->token, "/nowhere/", false, false, NULL, log_of_3, NULL, NULL, NULL);
  return FUNCTION(fmu, fmi3InstantiateCoSimulation, "InstantiateCoSimulation")(
      "arm", fmu->token, "/nowhere/", false, false, false, false, &any, 1, NULL, log_of_3, NULL);
}

int fmu_set_time(Instance *instance, double time) {
  return is_two(instance) ? CALL2(SetTime, time) : CALL3(SetTime, time);
}

void fmu_free(Instance *instance) {
  if (is_two(instance))
    FUNCTION(instance->fmu, fmi2FreeInstance, "FreeInstance")(instance->handle);
  else
    FUNCTION(instance->fmu, fmi3FreeInstance, "FreeInstance")(instance->handle);
  instance->handle = NULL;
}

/* A time or a tolerance that is not defined has any value. */
int fmu_enter_with(Instance *instance, double start, double tolerance, double stop) {
  bool stops = isfinite(stop), tolerates = !isnan(tolerance);
  if (!stops) stop = start - 1;
  if (!tolerates) tolerance = -1;
  if (!is_two(instance)) return CALL3(EnterInitializationMode, tolerates, tolerance, start, stops, stop);
  int status = CALL2(SetupExperiment, tolerates, tolerance, start, stops, stop);
  return status == fmi2OK ? CALL2(EnterInitializationMode) : status;
}

int fmu_enter_until(Instance *instance, double start, double stop) {
  return fmu_enter_with(instance, start, NAN, stop);
}

int fmu_enter(Instance *instance, double start) {
  return fmu_enter_until(instance, start, INFINITY);
}

int fmu_exit(Instance *instance) {
  return is_two(instance) ? CALL2(ExitInitializationMode) : CALL3(ExitInitializationMode);
}

int fmu_terminate(Instance *instance) {
  return is_two(instance) ? CALL2(Terminate) : CALL3(Terminate);
}

int fmu_reset(Instance *instance) {
  return is_two(instance) ? CALL2(Reset) : CALL3(Reset);
}

int fmu_step(Instance *instance, double now, double size) {
  bool event, terminate, early;
  double reached;
  return is_two(instance) ? CALL2(DoStep, now, size, fmi2True)
                          : CALL3(DoStep, now, size, true, &event, &terminate, &early, &reached);
}

int fmu_try_get(Instance *instance, const Variable *v, double *value) {
  int integer = 0, status;
  int64_t word = 0;
  bool truth = false;
  const uint32_t *r = &v->reference;
  if (v->kind == KIND_REAL) return is_two(instance) ? CALL2(GetReal, r, 1, value) : CALL3(GetFloat64, r, 1, value, 1);
  if (is_two(instance)) {
    status = v->kind == KIND_BOOLEAN ? CALL2(GetBoolean, r, 1, &integer) : CALL2(GetInteger, r, 1, &integer);
    *value = integer;
  } else if (v->kind == KIND_INTEGER) {
    status = CALL3(GetInt32, r, 1, &integer, 1);
    *value = integer;
  } else if (v->kind == KIND_ENUMERATION) {
    status = CALL3(GetInt64, r, 1, &word, 1);
    *value = (double)word;
  } else {
    status = CALL3(GetBoolean, r, 1, &truth, 1);
    *value = truth;
  }
  return status;
}

int fmu_try_set(Instance *instance, const Variable *v, double value) {
  int integer = v->kind == KIND_REAL ? 0 : (int)value;
  int64_t word = integer;
  bool truth = integer != 0;
  const uint32_t *r = &v->reference;
  if (v->kind == KIND_REAL) return is_two(instance) ? CALL2(SetReal, r, 1, &value) : CALL3(SetFloat64, r, 1, &value, 1);
  if (is_two(instance))
    return v->kind == KIND_BOOLEAN ? CALL2(SetBoolean, r, 1, &integer) : CALL2(SetInteger, r, 1, &integer);
  if (v->kind == KIND_INTEGER) return CALL3(SetInt32, r, 1, &integer, 1);
  return v->kind == KIND_ENUMERATION ? CALL3(SetInt64, r, 1, &word, 1) : CALL3(SetBoolean, r, 1, &truth, 1);
}

int fmu_set_slope(Instance *instance, const Variable *v, double slope) {
  const fmi2Integer first = 1;
  return CALL2(SetRealInputDerivatives, &v->reference, 1, &first, &slope);
}

int fmu_get_state(Instance *instance, void **state) {
  return is_two(instance) ? CALL2(GetFMUstate, state) : CALL3(GetFMUState, state);
}

int fmu_set_state(Instance *instance, void *state) {
  return is_two(instance) ? CALL2(SetFMUstate, state) : CALL3(SetFMUState, state);
}

int fmu_free_state(Instance *instance, void **state) {
  return is_two(instance) ? CALL2(FreeFMUstate, state) : CALL3(FreeFMUState, state);
}

int fmu_state_size(Instance *instance, void *state, size_t *size) {
  return is_two(instance) ? CALL2(SerializedFMUstateSize, state, size) : CALL3(SerializedFMUStateSize, state, size);
}

int fmu_serialize(Instance *instance, void *state, void *bytes, size_t size) {
  return is_two(instance) ? CALL2(SerializeFMUstate, state, bytes, size) : CALL3(SerializeFMUState, state, bytes, size);
}

int fmu_deserialize(Instance *instance, const void *bytes, size_t size, void **state) {
  return is_two(instance) ? CALL2(DeSerializeFMUstate, bytes, size, state)
                          : CALL3(DeserializeFMUState, bytes, size, state);
}

int fmu_derivative(Instance *instance, const Variable *unknown, const Variable *known, double *value) {
  const double seed = 1;
  const uint32_t *u = &unknown->reference, *k = &known->reference;
  return is_two(instance) ? CALL2(GetDirectionalDerivative, u, 1, k, 1, &seed, value)
                          : CALL3(GetDirectionalDerivative, u, 1, k, 1, &seed, 1, value, 1);
}

double fmu_get(Instance *instance, const char *name) {
  double value = 0;
  ck_assert_msg(fmu_try_get(instance, fmu_find(instance->fmu, name), &value) == 0, "%s: %s", name, last_message);
  return value;
}

void fmu_set(Instance *instance, const char *name, double value) {
  int status = fmu_try_set(instance, fmu_find(instance->fmu, name), value);
  ck_assert_msg(status == 0, "%s = %g: %s", name, value, last_message);
}

void fmu_start(Instance *instance) {
  ck_assert_msg(fmu_enter(instance, 0) == 0 && fmu_exit(instance) == 0, "%s", last_message);
}
