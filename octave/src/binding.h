/* Common functions of the MEX function.
 *
 * An error of the interpreter (mexErrMsgIdAndTxt, but also a failed mxCreate...) jumps out of the call. To lose no
 * memory then, texts are in the memory of the interpreter, which frees it, and objects of the library belong to `call`,
 * which is freed when the next call starts. */
#ifndef ZIPACT_OCTAVE_BINDING_H
#define ZIPACT_OCTAVE_BINDING_H

#include <mex.h>

#include <zipact/batch.h>
#include <zipact/calibrate.h>
#include <zipact/zipact.h>

/* The objects of the current call. */
typedef struct Call {
  ZpScenario *scenario;
  ZpActuatorDef *def;
  ZpBatch batch;
  ZpShapes *film;
} Call;
extern Call call;

/* -- failures (zipact_mex.c): none returns ------------------------------------------------------------ */

_Noreturn void fail(const ZpError *err);
_Noreturn void fail_memory(void);
_Noreturn void fail_numerics(const char *message);
_Noreturn void fail_interrupted(void);
__attribute__((format(printf, 1, 2))) _Noreturn void fail_input(const char *format, ...);

/* -- values => the library (arguments.c) --------------------------------------------------------------- */

/* The text in a row of characters; otherwise fails with a message about `what`. */
char *text_of(const mxArray *value, const char *what);

/* A quantity with the unit and range of a key but another name, such as dt. */
double quantity_of(const char *key, const char *name, const mxArray *value);

/* Fill call.scenario from [FILE or STRUCT,] KEY, VALUE, ... */
void read_scenario(int count, const mxArray *const *value);

/* Definition `row` of call.scenario, in call.def. */
const ZpActuatorDef *read_def(size_t row);

/* -- the library => structs (result.c) ------------------------------------------------------------------ */

mxArray *new_struct(void);

/* Set a field of structs[index], which is created if needed; characters in `name` other than letters, digits and _
 * become _. */
void set(mxArray *structs, size_t index, const char *name, mxArray *value);

/* [rows x columns] numbers; NULL: zeros. */
mxArray *new_matrix(size_t rows, size_t columns, const double *value);

mxArray *keys_struct(void);
mxArray *shapes_struct(const ZpShapes *shapes);
void set_result(mxArray *structs, size_t index, const ZpResult *result, const ZpActuatorDef *def);

/* -- long calls (watch.c) ------------------------------------------------------------------------------- */

/* Between these two calls Ctrl-C stops the library instead of the interpreter. */
void watch_begin(void);
bool watch_end(void); /* true if it was pressed */
extern const ZpHooks watch_hooks;

/* -- simulations by hand (simulation.c): arguments => result, NULL if there is none ---------------------- */

mxArray *simulation_open(int count, const mxArray *const *value);
mxArray *simulation_step(int count, const mxArray *const *value);
mxArray *simulation_input(int count, const mxArray *const *value);
mxArray *simulation_inputs(int count, const mxArray *const *value);
mxArray *simulation_control(int count, const mxArray *const *value);
mxArray *simulation_read(int count, const mxArray *const *value);
mxArray *simulation_shape(int count, const mxArray *const *value);
mxArray *simulation_save(int count, const mxArray *const *value);
mxArray *simulation_restore(int count, const mxArray *const *value);
mxArray *simulation_close(int count, const mxArray *const *value);
void simulation_close_all(void);

#endif
