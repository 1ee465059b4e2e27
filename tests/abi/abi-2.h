/* The public headers as they were when interface 2 began, without comments, for programs that are older than the
 * library: tests/test_interface.py compiles program.c with it. A release with ZP_ABI 2 fixes it. */
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

typedef enum ZpStatus { ZP_OK = 0, ZP_BAD_INPUT = 2, ZP_MACHINE = 3 } ZpStatus;
typedef struct ZpError {
  ZpStatus status;
  char message[512];
} ZpError;
typedef enum ZpStudy {
  ZP_STUDY_ACTUATE,
  ZP_STUDY_STATIONARY,
  ZP_STUDY_EQUILIBRIUM,
  ZP_STUDY_MODES,
  ZP_STUDY_ISOMETRIC,
  ZP_STUDY_PROFILE,
  ZP_STUDY_CALIBRATE,
  ZP_STUDY_LIMITS,
  ZP_STUDY_CYCLE,
  ZP_STUDY_PLAN,
} ZpStudy;
typedef enum ZpPreset {
  ZP_PRESET_NONE,
  ZP_PRESET_PAPER_TEXT,
  ZP_PRESET_PAPER_CODE,
  ZP_PRESET_PAPER_FE,
} ZpPreset;
typedef enum ZpActuatorKind {
  ZP_KIND_ELECTRO_RIBBON,
  ZP_KIND_RIBBON,
  ZP_KIND_FLANGE,
  ZP_KIND_HINGE,
  ZP_KIND_MOUTH,
  ZP_KIND_POUCH,
  ZP_KIND_CURVED,
  ZP_KIND_PLATE,
} ZpActuatorKind;
typedef enum ZpRightEnd {
  ZP_END_GUIDED,
  ZP_END_FREE,
  ZP_END_CLAMPED,
} ZpRightEnd;
typedef enum ZpSymmetry {
  ZP_SYMMETRY_HALF,
  ZP_SYMMETRY_NONE,
} ZpSymmetry;
typedef enum ZpHeldClip {
  ZP_HELD_NONE,
  ZP_HELD_LEFT,
  ZP_HELD_RIGHT,
} ZpHeldClip;
typedef enum ZpPlane {
  ZP_PLANE_STRAIN,
  ZP_PLANE_STRESS,
  ZP_PLANE_ANTICLASTIC,
} ZpPlane;
typedef enum ZpRibbonModel {
  ZP_RIBBON_ROD,
  ZP_RIBBON_MASS_SPRING,
} ZpRibbonModel;
typedef enum ZpAxialLaw {
  ZP_AXIAL_TEXT,
  ZP_AXIAL_CODE,
} ZpAxialLaw;
typedef enum ZpElectroModel {
  ZP_ELECTRO_PLATES,
  ZP_ELECTRO_FIELD,
} ZpElectroModel;
typedef enum ZpSurface {
  ZP_SURFACE_POLYLINE,
  ZP_SURFACE_BEZIER,
} ZpSurface;
typedef enum ZpLiquidModel {
  ZP_LIQUID_NONE,
  ZP_LIQUID_SUBMERGED,
  ZP_LIQUID_BEAD,
  ZP_LIQUID_AUTO,
} ZpLiquidModel;
typedef enum ZpContactModel {
  ZP_CONTACT_SEQUENTIAL,
  ZP_CONTACT_UNILATERAL,
} ZpContactModel;
typedef enum ZpWaveformKind {
  ZP_WAVEFORM_STEP,
  ZP_WAVEFORM_RAMP,
  ZP_WAVEFORM_SINE,
  ZP_WAVEFORM_SQUARE,
  ZP_WAVEFORM_TABLE,
} ZpWaveformKind;
typedef enum ZpControlKind {
  ZP_CONTROL_NONE,
  ZP_CONTROL_PI,
  ZP_CONTROL_BOOST_PI,
} ZpControlKind;
typedef enum ZpControlSignal {
  ZP_CONTROL_OPENING,
  ZP_CONTROL_STROKE,
  ZP_CONTROL_CONTRACTION,
  ZP_CONTROL_CAPACITANCE,
  ZP_CONTROL_ANGLE,
} ZpControlSignal;
typedef enum ZpSourceModel {
  ZP_SOURCE_IDEAL,
  ZP_SOURCE_AMPLIFIER,
} ZpSourceModel;
typedef enum ZpSupplyName {
  ZP_SUPPLY_NONE,
  ZP_SUPPLY_POCKET_6KV,
  ZP_SUPPLY_OPEN_5KV,
  ZP_SUPPLY_EIGHT_CHANNEL,
  ZP_SUPPLY_LABORATORY_10KV,
  ZP_SUPPLY_CONVERTER_10KV,
  ZP_SUPPLY_MEASURED_10KV,
} ZpSupplyName;
typedef enum ZpStripMaterial {
  ZP_STRIP_NONE,
  ZP_STRIP_STEEL_1_4310,
  ZP_STRIP_STEEL_1_1248,
  ZP_STRIP_STEEL_301,
  ZP_STRIP_COPPER,
  ZP_STRIP_ALUMINIUM,
  ZP_STRIP_BRASS,
} ZpStripMaterial;
typedef enum ZpInsulatorMaterial {
  ZP_INSULATOR_NONE,
  ZP_INSULATOR_PVC_TAPE,
  ZP_INSULATOR_KAPTON,
  ZP_INSULATOR_PET,
  ZP_INSULATOR_MYLAR,
  ZP_INSULATOR_PDMS,
} ZpInsulatorMaterial;
typedef enum ZpMediumMaterial {
  ZP_MEDIUM_NONE,
  ZP_MEDIUM_SILICONE_OIL_5CST,
  ZP_MEDIUM_SILICONE_OIL_10CST,
  ZP_MEDIUM_SILICONE_OIL_50CST,
  ZP_MEDIUM_SILICONE_OIL_100CST,
  ZP_MEDIUM_SILICONE_OIL_350CST,
  ZP_MEDIUM_FR3,
  ZP_MEDIUM_MINERAL_OIL,
  ZP_MEDIUM_AIR,
  ZP_MEDIUM_WATER,
  ZP_MEDIUM_VACUUM,
} ZpMediumMaterial;
typedef enum ZpWhen {
  ZP_WHEN_AUTO,
  ZP_WHEN_TRUE,
  ZP_WHEN_FALSE,
} ZpWhen;
typedef enum ZpCycleMethod {
  ZP_CYCLE_AUTO,
  ZP_CYCLE_MOTION,
  ZP_CYCLE_LINEAR,
} ZpCycleMethod;
typedef enum ZpIntegrator {
  ZP_INTEGRATOR_EXPLICIT,
  ZP_INTEGRATOR_IMPLICIT,
} ZpIntegrator;
typedef enum ZpMoves {
  ZP_MOVES_VERTICAL,
  ZP_MOVES_PLANE,
  ZP_MOVES_NONE,
} ZpMoves;
typedef enum ZpSpringKind {
  ZP_SPRING_BOTH,
  ZP_SPRING_PULL,
  ZP_SPRING_PUSH,
} ZpSpringKind;
typedef enum ZpJointType {
  ZP_JOINS_PIN,
  ZP_JOINS_SLIDE,
  ZP_JOINS_WELD,
} ZpJointType;
typedef enum ZpInitialState {
  ZP_INITIAL_EQUILIBRIUM,
  ZP_INITIAL_STRAIGHT,
  ZP_INITIAL_CHECKPOINT,
} ZpInitialState;
typedef enum ZpProfileShape {
  ZP_PROFILE_HELD,
  ZP_PROFILE_CUBIC,
} ZpProfileShape;
typedef enum ZpSampling {
  ZP_SAMPLING_SOBOL,
  ZP_SAMPLING_LATIN_HYPERCUBE,
  ZP_SAMPLING_RANDOM,
} ZpSampling;
typedef enum ZpTolerances {
  ZP_TOLERANCES_GIVEN,
  ZP_TOLERANCES_MATERIALS,
  ZP_TOLERANCES_BASE,
} ZpTolerances;
typedef enum ZpPlanCriterion {
  ZP_PLAN_D,
  ZP_PLAN_A,
} ZpPlanCriterion;
typedef enum ZpOptimizer {
  ZP_OPTIMIZER_AUTO,
  ZP_OPTIMIZER_SLSQP,
  ZP_OPTIMIZER_COBYLA,
  ZP_OPTIMIZER_NSGA2,
} ZpOptimizer;
typedef struct ZpActuatorDef ZpActuatorDef;
typedef enum ZpKeyType { ZP_KEY_REAL, ZP_KEY_REAL_AUTO, ZP_KEY_INT, ZP_KEY_BOOL, ZP_KEY_ENUM, ZP_KEY_TEXT } ZpKeyType;
typedef struct ZpChoice {
  const char *word;
  const char *help;
} ZpChoice;
typedef struct ZpKey {
  const char *name;
  ZpKeyType type;
  const char *unit;
  const char *shown;
  double def;
  double min;
  double max;
  const char *help;
  const ZpChoice *choices;
  const char *text;
} ZpKey;
typedef struct ZpAssignment {
  int key;
  double value;
} ZpAssignment;
typedef struct ZpMaterialValue {
  int material;
  const char *name;
  double value;
  double spread;
  const char *source;
} ZpMaterialValue;
ZpActuatorDef *zp_def_create(void);
ZpActuatorDef *zp_def_copy(const ZpActuatorDef *def);
void zp_def_destroy(ZpActuatorDef *def);
int zp_key_count(void);
const ZpKey *zp_key(int index);
int zp_key_find(const char *name);
const char *zp_key_name(int index, char text[64]);
int zp_word_distance(const char *a, const char *b);
const char *zp_key_nearest(const char *name);
void zp_key_unknown(const char *name, char *text, size_t size);
int zp_key_choice(int index, const char *word);

_Bool zp_key_in_def(int index);
int zp_def_next_key(const ZpActuatorDef *def, int index);
double zp_def_get(const ZpActuatorDef *def, int index);
ZpStatus zp_def_set(ZpActuatorDef *def, int index, double value, ZpError *err);
const char *zp_def_text(const ZpActuatorDef *def, int index);
ZpStatus zp_def_set_text(ZpActuatorDef *def, int index, const char *text, ZpError *err);
double zp_def_number(const ZpActuatorDef *def, const char *key);
ZpStatus zp_def_set_number(ZpActuatorDef *def, const char *key, double value, ZpError *err);
const char *zp_def_word(const ZpActuatorDef *def, const char *key);
ZpStatus zp_def_set_word(ZpActuatorDef *def, const char *key, const char *word, ZpError *err);
int zp_def_members(const ZpActuatorDef *def);

_Bool zp_key_is_material(int index);
const ZpMaterialValue *zp_material_value(const ZpActuatorDef *def, int index);
ZpStatus zp_def_resolve(ZpActuatorDef *def, const ZpAssignment *list, size_t count, ZpError *err);
ZpStatus zp_def_check(const ZpActuatorDef *def, ZpError *err);
ZpStatus zp_def_check_motion(const ZpActuatorDef *def, ZpError *err);

_Bool zp_def_takes_table(const ZpActuatorDef *def);
ZpStatus zp_def_check_voltage(const ZpActuatorDef *def, double voltage, ZpError *err);
ZpLiquidModel zp_def_liquid(const ZpActuatorDef *def);
double zp_def_roughness(const ZpActuatorDef *def);
double zp_def_tolerance(const ZpActuatorDef *def);
typedef struct ZpDriveTable {
  size_t rows;
  const double *time;
  const double *voltage;
} ZpDriveTable;
const char *zp_drive_table_fault(const ZpDriveTable *table, size_t *row);
typedef struct ZpModel ZpModel;
ZpStatus zp_model_create(const ZpActuatorDef *def, ZpModel **model, ZpError *err);
ZpStatus zp_model_create_driven(const ZpActuatorDef *def, const ZpDriveTable *table, ZpModel **model, ZpError *err);
void zp_model_destroy(ZpModel *model);
const ZpActuatorDef *zp_model_def(const ZpModel *model);
double zp_model_get(const ZpModel *model, const char *name);
typedef struct ZpColumn {
  const char *name;
  const char *unit;
  const char *help;
} ZpColumn;
typedef struct ZpTable ZpTable;
ZpTable *zp_table_create(const ZpColumn *column, size_t columns, size_t capacity);
void zp_table_destroy(ZpTable *table);

_Bool zp_table_offer(ZpTable *table, const double *row);
void zp_table_keep_last(ZpTable *table, const double *row);
double zp_table_get(const ZpTable *table, size_t row, const char *name);
size_t zp_table_rows(const ZpTable *table);
size_t zp_table_columns(const ZpTable *table);
const ZpColumn *zp_table_column(const ZpTable *table, size_t column);
const double *zp_table_row(const ZpTable *table, size_t row);
typedef struct ZpShape {
  double time;
  double voltage;
  size_t zipped;
  const double *x;
  const double *y;
  const double *gap;
  const double *line_force;
  const double *insulator_field;
  const double *stress;
} ZpShape;
typedef struct ZpShapes ZpShapes;
ZpShapes *zp_shapes_create(size_t ribbons, size_t nodes, size_t capacity);
void zp_shapes_destroy(ZpShapes *shapes);

_Bool zp_shapes_offer(ZpShapes *shapes, const ZpShape *shape);
void zp_shapes_keep_last(ZpShapes *shapes, const ZpShape *shape);
ZpShape zp_shapes_get(const ZpShapes *shapes, size_t frame);
size_t zp_shapes_frames(const ZpShapes *shapes);
size_t zp_shapes_ribbons(const ZpShapes *shapes);
size_t zp_shapes_nodes(const ZpShapes *shapes);
size_t zp_shapes_members(const ZpShapes *shapes);
size_t zp_shapes_stride(const ZpShapes *shapes);
typedef struct ZpSim ZpSim;
typedef enum ZpOutcome {
  ZP_REACHED_END,
  ZP_ZIPPED,
  ZP_INTERRUPTED,
  ZP_NOT_SETTLED,
  ZP_DIVERGED,
  ZP_STEP_LIMIT,
  ZP_CONVERGED,
  ZP_FOLLOWED,
  ZP_BRANCH_LOST,
  ZP_BAD_ARGUMENT,
  ZP_SHORT_CIRCUIT,
  ZP_PULLED_IN,
  ZP_EVENT,
  ZP_AT_BOUND,
  ZP_TIME_LIMIT,
  ZP_REOPENED,
  ZP_BEYOND_MODEL,
  ZP_DOUBTFUL
} ZpOutcome;
const char *zp_outcome_name(ZpOutcome outcome);

_Bool zp_outcome_good(ZpOutcome outcome);
typedef struct ZpHooks {
  void *user;
  _Bool (*progress)(void *user, const char *stage, double fraction);
  double (*clock)(void *user);
} ZpHooks;
typedef enum ZpStepLimit {
  ZP_LIMIT_TIME_STEP,
  ZP_LIMIT_STABILITY,
  ZP_LIMIT_DRAG,
  ZP_LIMIT_EVENT,
  ZP_LIMIT_ERROR,
  ZP_LIMIT_END,
  ZP_LIMIT_COUNT
} ZpStepLimit;
const char *zp_step_limit_name(ZpStepLimit limit);
typedef struct ZpRunInfo ZpRunInfo;
ZpRunInfo *zp_run_info_create(void);
void zp_run_info_destroy(ZpRunInfo *info);
ZpOutcome zp_run_info_outcome(const ZpRunInfo *info);
const char *zp_run_info_message(const ZpRunInfo *info);
int64_t zp_run_info_limited(const ZpRunInfo *info, ZpStepLimit limit);
double zp_run_info_get(const ZpRunInfo *info, const char *name);
ZpStatus zp_sim_create(const ZpModel *model, const ZpHooks *hooks, ZpSim **sim, ZpError *err);
void zp_sim_destroy(ZpSim *sim);
void zp_sim_record(ZpSim *sim, ZpTable *series, ZpShapes *shapes);
ZpOutcome zp_sim_run(ZpSim *sim, double end_time, _Bool stop_when_zipped, const ZpHooks *hooks, ZpRunInfo *info);
ZpOutcome zp_sim_step(ZpSim *sim, double dt, const ZpHooks *hooks, ZpRunInfo *info);
ZpOutcome zp_sim_step_to_event(ZpSim *sim, double dt, const ZpHooks *hooks, ZpRunInfo *info);
ZpStatus zp_sim_set_voltage(ZpSim *sim, double voltage, ZpError *err);
typedef enum ZpInput { ZP_INPUT_VOLTAGE, ZP_INPUT_LOAD, ZP_INPUT_SETPOINT, ZP_INPUT_COUNT } ZpInput;
const char *zp_input_name(ZpInput input);
enum { ZP_INPUT_NAME_SIZE = 48 };
int zp_def_input_next(const ZpActuatorDef *def, int input);
const char *zp_def_input_name(const ZpActuatorDef *def, int input, char text[ZP_INPUT_NAME_SIZE]);
const char *zp_def_input_unit(const ZpActuatorDef *def, int input);
int zp_def_input_find(const ZpActuatorDef *def, const char *name);
int zp_def_input_member(const ZpActuatorDef *def, int input, int *which);
ZpStatus zp_def_forget_ports(ZpActuatorDef *def, ZpError *err);
ZpStatus zp_sim_set_input(ZpSim *sim, ZpInput input, double value, double rate, ZpError *err);
ZpStatus zp_sim_set_input_named(ZpSim *sim, const char *name, double value, double rate, ZpError *err);
ZpStatus zp_sim_input_slopes(ZpSim *sim, ZpInput input, double *slope, ZpError *err);
size_t zp_sim_columns(const ZpSim *sim);
void zp_sim_read_columns(ZpSim *sim, size_t columns, double *row);
ZpStatus zp_sim_column_slopes(ZpSim *sim, ZpInput input, size_t columns, double *slope, ZpError *err);
typedef struct ZpController {
  double period;
  void *user;
  double (*voltage)(void *user, ZpSim *sim, double time);
} ZpController;
ZpStatus zp_sim_set_controller(ZpSim *sim, const ZpController *controller, ZpError *err);
double zp_sim_get(ZpSim *sim, const char *name);
void zp_sim_read(ZpSim *sim, double *row);
typedef struct ZpRowStart {
  double time;
  double charge;
  double energy;
} ZpRowStart;
ZpRowStart zp_sim_row_start(const ZpSim *sim);
void zp_sim_set_row_start(ZpSim *sim, ZpRowStart start);
void zp_sim_start_row(ZpSim *sim);
ZpShape zp_sim_shape(ZpSim *sim);
typedef struct ZpLiquid {
  const double *thickness;
  const double *pressure;
  const double *wet_length;
} ZpLiquid;
ZpLiquid zp_sim_liquid(ZpSim *sim);
double zp_sim_zip_time(const ZpSim *sim);
double zp_sim_closed_from(const ZpSim *sim);
double zp_sim_starved_time(const ZpSim *sim);
size_t zp_sim_state_size(const ZpSim *sim);
void zp_sim_save(const ZpSim *sim, void *bytes);
ZpStatus zp_sim_restore(ZpSim *sim, const void *bytes, size_t size, ZpError *err);
const ZpColumn *zp_signal_columns(size_t *count);
const char *zp_signal_name(size_t index);
const ZpColumn *zp_signal_columns_of(const ZpActuatorDef *def, size_t *count);
ZpTable *zp_signal_table(const ZpActuatorDef *def, size_t capacity);
const char *zp_control_unit(const ZpActuatorDef *def);
int zp_signal_find(const char *name);
ZpStatus zp_sim_take_over(ZpSim *sim, const ZpSim *from, ZpError *err);
typedef struct ZpCheckpoint {
  size_t size;
  unsigned char *byte;
} ZpCheckpoint;
ZpStatus zp_checkpoint_from(const void *bytes, size_t size, ZpCheckpoint **out, ZpError *err);
void zp_checkpoint_destroy(ZpCheckpoint *checkpoint);
double zp_checkpoint_time(const ZpCheckpoint *checkpoint);

_Bool zp_checkpoint_holds(int index);
ZpStatus zp_checkpoint_check(const ZpCheckpoint *checkpoint, const ZpActuatorDef *def, ZpError *err);
ZpStatus zp_sim_checkpoint(const ZpSim *sim, ZpCheckpoint **out, ZpError *err);
ZpStatus zp_sim_continue(ZpSim *sim, const ZpCheckpoint *checkpoint, ZpError *err);
typedef struct ZpRest ZpRest;
ZpStatus zp_rest_create(const ZpModel *model, ZpRest **rest, ZpError *err);
void zp_rest_destroy(ZpRest *rest);

_Bool zp_rest_hang(ZpRest *rest, double voltage);
double zp_rest_stroke(const ZpRest *rest);
double zp_rest_opening(const ZpRest *rest);
double zp_rest_capacitance(const ZpRest *rest);
ZpStatus zp_rest_sensitivity(ZpRest *rest, int key, double *stroke, double *opening, ZpError *err);
typedef struct ZpScalar {
  const char *name;
  const char *unit;
  double value;
  _Bool timing;
} ZpScalar;
typedef struct ZpSensitivity {
  const char *output;
  int key;
  double value;
} ZpSensitivity;
typedef struct ZpFieldMap {
  size_t nx, ny;
  double *x, *y;
  double *potential;
  double *strength;
  double *permittivity;
  size_t surface[6];
  void *memory;
} ZpFieldMap;
ZpFieldMap *zp_field_map_create(size_t nx, size_t ny);
void zp_field_map_destroy(ZpFieldMap *map);
typedef struct ZpResult ZpResult;
const char *zp_study_name(ZpStudy study);

_Bool zp_study_follows(ZpStudy study);
ZpStatus zp_study_check(ZpStudy study, const ZpActuatorDef *def, ZpError *err);
typedef struct ZpStudyInput {
  const ZpDriveTable *table;
  const ZpCheckpoint *start;
  const ZpResult *neighbour;
} ZpStudyInput;
ZpStatus zp_study_run(ZpStudy study, const ZpActuatorDef *def, const ZpStudyInput *input, const ZpHooks *hooks,
                      ZpResult **result, ZpError *err);
ZpResult *zp_result_create(ZpStudy study);
void zp_result_add_sensitivity(ZpResult *result, const char *output, int key, double value);
void zp_result_add(ZpResult *result, const char *name, const char *unit, double value);
void zp_result_add_timing(ZpResult *result, const char *name, const char *unit, double value);
void zp_result_add_of(ZpResult *result, const char *name, const char *called, const char *unit, double value);
void zp_result_note(ZpResult *result, const char *format, ...);
void zp_result_note_model(ZpResult *result, const ZpModel *model, double highest);
void zp_result_forget_states(ZpResult *result);
void zp_result_destroy(ZpResult *result);
double zp_result_get(const ZpResult *result, const char *name);
ZpStudy zp_result_study(const ZpResult *result);
ZpOutcome zp_result_outcome(const ZpResult *result);
const char *zp_result_message(const ZpResult *result);
size_t zp_result_notes(const ZpResult *result);
const char *zp_result_note_text(const ZpResult *result, size_t index);
double zp_result_resolution(const ZpResult *result);
size_t zp_result_scalars(const ZpResult *result);
const ZpScalar *zp_result_scalar(const ZpResult *result, size_t index);
size_t zp_result_sensitivities(const ZpResult *result);
const ZpSensitivity *zp_result_sensitivity(const ZpResult *result, size_t index);
const ZpTable *zp_result_series(const ZpResult *result);
const ZpShapes *zp_result_shapes(const ZpResult *result);
const ZpFieldMap *zp_result_map(const ZpResult *result);
const ZpCheckpoint *zp_result_checkpoint(const ZpResult *result);
enum { ZP_TRACE_SIGNALS = 8, ZP_TRACE_KEYS = 8 };
typedef struct ZpTrace ZpTrace;
ZpStatus zp_trace_create(const ZpModel *model, const char *const *signal, size_t signals, const int *key, size_t keys,
                         double end, const ZpHooks *hooks, ZpTrace **trace, ZpError *err);
void zp_trace_destroy(ZpTrace *trace);
typedef struct ZpTraceValue {
  double value, rate, by_key[ZP_TRACE_KEYS];
} ZpTraceValue;
ZpTraceValue zp_trace_at(const ZpTrace *trace, size_t signal, double time);
const char *zp_version(void);
typedef struct ZpScenario ZpScenario;
ZpScenario *zp_scenario_create(void);
void zp_scenario_destroy(ZpScenario *scenario);
ZpStatus zp_scenario_read(ZpScenario *scenario, const char *path, ZpError *err);
ZpStatus zp_scenario_parse(ZpScenario *scenario, const char *text, size_t size, const char *name, ZpError *err);
ZpStatus zp_scenario_override(ZpScenario *scenario, const char *text, size_t size, const char *name, ZpError *err);
ZpStatus zp_scenario_set(ZpScenario *scenario, const char *assignment, ZpError *err);
size_t zp_scenario_count(const ZpScenario *scenario);
const int *zp_scenario_lists(const ZpScenario *scenario, size_t *count);
enum { ZP_SCENARIO_KEY_SIZE = 128 };
const char *zp_scenario_key(const ZpScenario *scenario, int key, char text[ZP_SCENARIO_KEY_SIZE]);

_Bool zp_scenario_bare_number(const ZpScenario *scenario, int key, double *value);

_Bool zp_scenario_keeps_series(const ZpScenario *scenario);
ZpStudy zp_scenario_study(const ZpScenario *scenario);
ZpStatus zp_scenario_def(const ZpScenario *scenario, size_t index, ZpActuatorDef *def, ZpError *err);
ZpStatus zp_scenario_write(const ZpScenario *scenario, FILE *file, ZpError *err);
typedef enum ZpKeysFormat { ZP_KEYS_TEXT, ZP_KEYS_JSON, ZP_KEYS_YAML, ZP_KEYS_SCHEMA } ZpKeysFormat;
ZpStatus zp_keys_write(ZpKeysFormat format, FILE *file, ZpError *err);
ZpStatus zp_value_parse(int index, const char *text, double *value, ZpError *err);
ZpStatus zp_def_set_value(ZpActuatorDef *def, const char *key, const char *text, ZpError *err);
size_t zp_result_save(const ZpResult *result, void *bytes);
ZpStatus zp_result_load(const void *bytes, size_t size, ZpResult **result, ZpError *err);
ZpStatus zp_templates_write(const char *folder, ZpError *err);
void zp_value_print(int index, double value, char *text, size_t size);
ZpStatus zp_checkpoint_write(const ZpCheckpoint *checkpoint, FILE *file, ZpError *err);
ZpStatus zp_checkpoint_read(const char *path, ZpCheckpoint **out, ZpError *err);
const char *zp_library_at_work(void);
ZpStatus zp_hdf5_skip_exit(ZpError *err);
int zp_processors(void);
typedef struct ZpFolder ZpFolder;
ZpStatus zp_folder_open(const char *directory, ZpFolder **out, ZpError *err);
void zp_folder_close(ZpFolder *folder);
typedef struct ZpRows {
  const ZpResult *(*get)(void *user, size_t index);
  ZpStatus (*status)(void *user, ZpError *err);
  void *user;
  _Bool (*open)(void *user, struct ZpRows *own);
  void (*close)(void *user);
} ZpRows;
typedef struct ZpOptimum {
  const size_t *row;
  size_t count;
  _Bool feasible;
  double excluded;
  ZpOutcome outcome;
  char message[256];
  const char *const *objective;
  size_t objectives;
  const char *const *constraint;
  size_t constraints;
  const char *const *statistic;
  const double *value;
  const int *variable;
  size_t variables;
  size_t samples;
} ZpOptimum;
typedef struct ZpReport {
  const char *directory;
  const ZpScenario *scenario;
  ZpResult *const *result;
  size_t count;
  double wall_time;
  const ZpFolder *folder;
  const ZpHooks *hooks;
  const ZpRows *rows;
  int jobs;
  const ZpOptimum *optimum;
  const char *templates;
} ZpReport;
double zp_report_largest(const ZpReport *report, const char *scalar, const char *where);
ZpStatus zp_summary_write(const ZpReport *report, FILE *file, ZpError *err);
ZpStatus zp_summary_write_line(const ZpReport *report, FILE *file, ZpError *err);
ZpStatus zp_report_write(const ZpReport *report, void (*notice)(const char *message), ZpError *err);
ZpStatus zp_batch_check(const ZpScenario *scenario, ZpError *err);
ZpStatus zp_batch_check_jobs(const ZpScenario *scenario, int jobs, ZpError *err);
typedef struct ZpBatch {
  const ZpScenario *scenario;
  ZpResult **result;
  size_t count;
  size_t done;
  size_t numbers;
  _Bool interrupted;
} ZpBatch;
ZpStatus zp_batch_create(const ZpScenario *scenario, ZpBatch *batch, ZpError *err);
void zp_batch_free(ZpBatch *batch);

_Bool zp_batch_open(const ZpBatch *batch);
ZpStatus zp_batch_next(ZpBatch *batch, const ZpHooks *hooks, ZpError *err);

_Bool zp_batch_good(const ZpBatch *batch);
ZpStatus zp_data_check(ZpStudy study, const ZpActuatorDef *def, ZpError *err);
ZpStatus zp_data_sim_create(const ZpActuatorDef *def, const ZpHooks *hooks, ZpModel **model, ZpSim **sim, ZpError *err);
ZpStatus zp_data_study_run(ZpStudy study, const ZpActuatorDef *def, const ZpHooks *hooks, ZpResult **result,
                           ZpError *err);
ZpStatus zp_study_run_limited(ZpStudy study, const ZpActuatorDef *def, const ZpStudyInput *input, const ZpHooks *hooks,
                              ZpResult **result, ZpError *err);
typedef struct ZpCampaign ZpCampaign;
typedef struct ZpCampaignState {
  size_t cases;
  size_t done;
  size_t resumed;
  size_t failed;
  double fraction;
} ZpCampaignState;
typedef struct ZpCampaignOptions {
  int jobs;
  _Bool resume;
  void *user;
  _Bool (*progress)(void *user, const ZpCampaignState *state);
  double (*clock)(void *user);
  ZpStatus (*remote)(void *remote_user, size_t worker, size_t from, size_t to, unsigned char **byte, size_t *size,
                     ZpError *err);
  void *remote_user;
} ZpCampaignOptions;
ZpStatus zp_campaign_compute(const ZpScenario *scenario, size_t from, size_t to, const ZpHooks *hooks,
                             unsigned char **byte, size_t *size, ZpError *err);
ZpStatus zp_campaign_open(const ZpScenario *scenario, const char *directory, const ZpCampaignOptions *options,
                          ZpCampaign **out, ZpError *err);
ZpStatus zp_campaign_run(ZpCampaign *campaign, ZpError *err);
ZpCampaignState zp_campaign_state(const ZpCampaign *campaign);
size_t zp_campaign_count(const ZpCampaign *campaign);
const ZpRows *zp_campaign_rows(const ZpCampaign *campaign);
void zp_campaign_close(ZpCampaign *campaign);
typedef struct ZpOptimization ZpOptimization;
ZpStatus zp_optimize(const ZpScenario *scenario, const char *directory, const ZpCampaignOptions *options,
                     ZpOptimization **out, ZpError *err);
const ZpReport *zp_optimization_report(const ZpOptimization *optimization);
ZpCampaignState zp_optimization_state(const ZpOptimization *optimization);
void zp_optimization_destroy(ZpOptimization *optimization);
ZpStatus zp_fmu_write(const ZpScenario *scenario, int version, const char *kit, const char *path, ZpError *err);
