/* zipact batch: one case per line of input, one result per line of output, for programs that choose the cases.
 *
 * The reading thread hands lines to workers through a ring. The worker that finishes the oldest line prints its answer
 * and all finished answers after it. So the answers keep the order of the lines, and each is printed as soon as all
 * answers before it are: a program may wait for an answer before it sends the next line. Ctrl-C ends the program at
 * once; printed answers are kept. */
#include <jansson.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <zipact/calibrate.h>

#include "cli.h"

/* Largest number of lines that are read before the oldest of them is answered. */
enum { RING = 256 };

typedef struct Line {
  char *text;
  size_t number; /* from 1 */
  char *answer;  /* NULL: not yet */
} Line;

typedef struct Batch {
  Options options;
  pthread_mutex_t lock; /* guards the members below */
  pthread_cond_t more, room;
  Line ring[RING];
  size_t read, taken, printed; /* number of lines so far */
  bool closed;                 /* the input has ended */
  ZpStatus status;             /* failure of the machine */
} Batch;

/* -- one line --------------------------------------------------------------------------------------- */

/* Remove the place "line 7:1: " from the message: the answer is already in the position of its line. */
static void drop_place(ZpError *err, const char *name) {
  const size_t length = strlen(name);
  const char *reason = strncmp(err->message, name, length) == 0 ? strstr(err->message + length, ": ") : NULL;
  if (reason) memmove(err->message, reason + 2, strlen(reason + 2) + 1);
}

/* => *scenario, to be destroyed whatever the status is. */
static ZpStatus read_case(const Options *o, const Line *line, ZpScenario **scenario, ZpError *err) {
  char name[32];
  size_t lists;
  const size_t blank = strspn(line->text, " \t\r\n");
  snprintf(name, sizeof name, "line %zu", line->number);
  *scenario = NULL;
  *err = (ZpError){ZP_BAD_INPUT, "give one JSON object per line: {\"load.mass\": \"8 g\"}"};
  if (line->text[blank] != '{') return ZP_BAD_INPUT;
  ZpStatus status = cli_read_scenario(NULL, o, scenario, err);
  if (status == ZP_OK) status = zp_scenario_override(*scenario, line->text, strlen(line->text), name, err);
  if (status != ZP_OK) {
    drop_place(err, name);
    return status;
  }
  zp_scenario_lists(*scenario, &lists);
  if (lists == 0) return ZP_OK;
  *err = (ZpError){ZP_BAD_INPUT, "a list of values; give one value per key, because a line is one case"};
  return ZP_BAD_INPUT;
}

static ZpStatus run_case(const ZpScenario *scenario, FILE *answer, ZpError *err) {
  ZpActuatorDef *def = zp_def_create();
  ZpResult *result = NULL;
  const double start = cli_wall_clock(NULL);
  const ZpHooks hooks = {.clock = cli_wall_clock};
  ZpStatus status = zp_scenario_def(scenario, 0, def, err);
  if (status == ZP_OK) status = zp_data_study_run(zp_scenario_study(scenario), def, &hooks, &result, err);
  zp_def_destroy(def);
  if (status != ZP_OK) return status;
  const ZpReport report = {
      .scenario = scenario, .result = &result, .count = 1, .wall_time = cli_wall_clock(NULL) - start};
  status = zp_summary_write_line(&report, answer, err);
  zp_result_destroy(result);
  return status;
}

static ZpStatus answer_case(const Options *o, const Line *line, FILE *answer, ZpError *err) {
  ZpScenario *scenario;
  ZpStatus status = read_case(o, line, &scenario, err);
  if (status == ZP_OK) status = run_case(scenario, answer, err);
  zp_scenario_destroy(scenario);
  return status;
}

/* {"error": "..."}, to be freed; NULL if there is no memory. */
static char *error_line(const ZpError *err) {
  json_t *object = json_pack("{ss}", "error", err->message);
  char *text = json_dumps(object, 0), *line = NULL;
  if (text && asprintf(&line, "%s\n", text) < 0) line = NULL;
  free(text);
  json_decref(object);
  return line;
}

/* => the answer, to be freed; NULL if there is no memory. */
static char *answer_of(const Options *o, const Line *line, ZpStatus *status) {
  char *text = NULL;
  size_t size;
  ZpError err;
  FILE *answer = open_memstream(&text, &size);
  *status = ZP_MACHINE;
  if (!answer) return NULL;
  *status = answer_case(o, line, answer, &err);
  if (fclose(answer) == 0 && *status == ZP_OK) return text;
  free(text);
  return error_line(&err);
}

/* -- all lines -------------------------------------------------------------------------------------- */

/* Print the finished answers in order. */
static void print_ready(Batch *batch) {
  for (Line *line; batch->printed < batch->read; batch->printed++) {
    line = &batch->ring[batch->printed % RING];
    if (!line->answer) break;
    fputs(line->answer, stdout);
    if (fflush(stdout) != 0) batch->status = ZP_MACHINE;
    free(line->text);
    free(line->answer);
    *line = (Line){0};
    pthread_cond_signal(&batch->room);
  }
}

/* The next line that no worker has taken; NULL after the last one. */
static Line *take(Batch *batch) {
  while (batch->taken == batch->read && !batch->closed)
    pthread_cond_wait(&batch->more, &batch->lock);
  return batch->taken < batch->read ? &batch->ring[batch->taken++ % RING] : NULL;
}

static void *work(void *user) {
  Batch *batch = user;
  pthread_mutex_lock(&batch->lock);
  for (Line *line; (line = take(batch));) {
    ZpStatus status;
    pthread_mutex_unlock(&batch->lock);
    char *answer = answer_of(&batch->options, line, &status);
    pthread_mutex_lock(&batch->lock);
    if (status == ZP_MACHINE) batch->status = ZP_MACHINE;
    line->answer = answer ? answer : strdup("{\"error\": \"no memory\"}\n");
    print_ready(batch);
  }
  pthread_mutex_unlock(&batch->lock);
  return NULL;
}

/* Hand lines to the workers until the input ends or the machine fails. */
static void read_lines(Batch *batch) {
  char *text = NULL;
  size_t room = 0;
  bool open = true;
  while (open && getline(&text, &room, stdin) >= 0) {
    pthread_mutex_lock(&batch->lock);
    while (batch->read - batch->printed == RING && batch->status == ZP_OK)
      pthread_cond_wait(&batch->room, &batch->lock);
    open = batch->status == ZP_OK;
    if (open) {
      batch->ring[batch->read % RING] = (Line){.text = text, .number = batch->read + 1};
      batch->read++;
      pthread_cond_signal(&batch->more);
      text = NULL;
      room = 0;
    }
    pthread_mutex_unlock(&batch->lock);
  }
  free(text);
  pthread_mutex_lock(&batch->lock);
  batch->closed = true;
  pthread_cond_broadcast(&batch->more);
  pthread_mutex_unlock(&batch->lock);
}

int cli_batch(const Options *o) {
  static Batch batch = {
      .lock = PTHREAD_MUTEX_INITIALIZER, .more = PTHREAD_COND_INITIALIZER, .room = PTHREAD_COND_INITIALIZER};
  ZpError err;
  ZpScenario *common; /* part of all lines: checked before the first line is read */
  const ZpStatus status = cli_read_scenario(NULL, o, &common, &err);
  zp_scenario_destroy(common);
  if (status != ZP_OK) return cli_fail(&err);
  const size_t jobs = (size_t)(o->jobs > 0 ? o->jobs : zp_processors());
  pthread_t *thread = calloc(jobs, sizeof *thread);
  size_t started = 0;
  batch.options = *o;
  batch.options.given |= OPTION_QUIET; /* messages about the common part are out */
  while (thread && started < jobs && pthread_create(&thread[started], NULL, work, &batch) == 0)
    started++;
  if (started > 0) read_lines(&batch);
  for (size_t i = 0; i < started; i++)
    pthread_join(thread[i], NULL);
  free(thread);
  if (started == 0) return cli_fail(&(ZpError){ZP_MACHINE, "no thread could be started"});
  if (batch.status == ZP_OK) return EXIT_DONE;
  return cli_fail(&(ZpError){ZP_MACHINE, "the machine failed; see the answers"});
}
