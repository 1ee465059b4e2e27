/* The MEX function: dispatches calls and reports errors. Its result is a cell with the value, or an empty cell, so that
 * zipact.m returns as many values as there are. */
#include "binding.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

Call call;

static void free_call(void) {
  zp_batch_free(&call.batch);
  zp_scenario_destroy(call.scenario);
  zp_def_destroy(call.def);
  zp_shapes_destroy(call.film);
  call = (Call){0};
}

static void at_exit(void) {
  free_call();
  simulation_close_all();
}

/* -- failures ------------------------------------------------------------------------------------------ */

static _Noreturn void jump(const char *id, const char *message) {
  mexErrMsgIdAndTxt(id, "%s", message);
  abort(); /* not reached: mex.h does not say that the function above never returns */
}

/* The library sees keys as --set of the command, which the user of Octave did not write. */
void fail(const ZpError *err) {
  static const char option[] = "--set ";
  size_t skip = strncmp(err->message, option, strlen(option)) == 0 ? strlen(option) : 0;
  jump(err->status == ZP_MACHINE ? "zipact:machine" : "zipact:input", err->message + skip);
}

void fail_memory(void) {
  jump("zipact:machine", "no memory");
}

void fail_numerics(const char *message) {
  jump("zipact:numerics", message);
}

void fail_interrupted(void) {
  jump("zipact:interrupted", "interrupted");
}

/* Messages quote the input, which may be invalid UTF-8: bytes beyond ASCII become question marks. */
void fail_input(const char *format, ...) {
  char message[sizeof((ZpError *)0)->message];
  va_list values;
  va_start(values, format);
  vsnprintf(message, sizeof message, format, values);
  va_end(values);
  for (char *c = message; *c; c++)
    if ((unsigned char)*c > '~') *c = '?';
  jump("zipact:input", message);
}

/* -- studies ------------------------------------------------------------------------------------------- */

/* Run call.scenario: a struct, or for lists an array of structs. */
static mxArray *run_scenario(void) {
  ZpError err;
  ZpStatus status = zp_batch_create(call.scenario, &call.batch, &err);
  watch_begin();
  while (status == ZP_OK && zp_batch_open(&call.batch))
    status = zp_batch_next(&call.batch, &watch_hooks, &err);
  bool interrupted = watch_end();
  if (status != ZP_OK) fail(&err);
  if (interrupted) fail_interrupted();
  mxArray *structs = mxCreateStructMatrix(1, call.batch.done, 0, NULL);
  for (size_t run = 0; run < call.batch.done; run++)
    set_result(structs, run, call.batch.result[run], read_def(run));
  return structs;
}

static mxArray *run(int count, const mxArray *const *value) {
  read_scenario(count, value);
  return run_scenario();
}

static mxArray *run_study(const char *study, int count, const mxArray *const *value) {
  char assignment[80];
  ZpError err;
  read_scenario(count, value);
  snprintf(assignment, sizeof assignment, "study=%s", study);
  if (zp_scenario_set(call.scenario, assignment, &err) != ZP_OK) fail(&err);
  return run_scenario();
}

/* -- what can be asked for ----------------------------------------------------------------------------- */

static mxArray *keys(int count, const mxArray *const *value) {
  (void)value;
  if (count) fail_input("keys: takes no further arguments");
  return keys_struct();
}

static mxArray *version(int count, const mxArray *const *value) {
  (void)value;
  if (count) fail_input("version: takes no further arguments");
  return mxCreateString(ZP_VERSION);
}

static const struct {
  const char *name;
  mxArray *(*answer)(int count, const mxArray *const *value);
} command[] = {
    {"run", run},
    {"keys", keys},
    {"version", version},
    {"open", simulation_open},
    {"step", simulation_step},
    {"input", simulation_input},
    {"inputs", simulation_inputs},
    {"control", simulation_control},
    {"read", simulation_read},
    {"shape", simulation_shape},
    {"save", simulation_save},
    {"restore", simulation_restore},
    {"close", simulation_close},
};

static mxArray *answer(const char *name, int count, const mxArray *const *value) {
  for (size_t i = 0; i < sizeof command / sizeof *command; i++)
    if (strcmp(name, command[i].name) == 0) return command[i].answer(count, value);
  if (zp_key_choice(zp_key_find("study"), name) >= 0) return run_study(name, count, value);
  fail_input(
      "%.80s: neither a study nor one of run, keys, version, open, step, input, inputs, control, read, shape, save, "
      "restore, close",
      name);
}

void mexFunction(int outputs, mxArray *output[], int inputs, const mxArray *input[]) {
  mexAtExit(at_exit);
  free_call();
  if (inputs == 0) fail_input("the first argument is missing: a study, or run, keys, open ...; see help zipact");
  if (outputs > 1) fail_input("returns one value");
  mxArray *value = answer(text_of(input[0], "the first argument"), inputs - 1, input + 1);
  output[0] = mxCreateCellMatrix(1, value != NULL);
  if (value) mxSetCell(output[0], 0, value);
  free_call();
}
