/* The program zipact-mpi: the first process does what zipact does, except that the other processes compute the cases of
 * a sweep.
 *
 * The first process has a thread per other process, which sends it some cases and waits. The others receive the
 * scenario in a message, so that only the first process reads it; all processes must find the files that keys name.
 * Waiting processes poll for messages: the waiting of MPI itself would occupy a processor each. */
#include <mpi.h>

#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "cli.h"

enum { FIRST = 0 };

/* Messages: a scenario as YAML; cases from .. to - 1, none at the end; their results after a byte for the status, or
 * the message of an error. */
enum { TAG_SCENARIO = 1, TAG_CASES, TAG_RESULTS };

static ZpStatus fail(ZpError *err, const char *message) {
  *err = (ZpError){.status = ZP_MACHINE};
  snprintf(err->message, sizeof err->message, "%.500s", message);
  return ZP_MACHINE;
}

/* Receive the next message of a process, of any length, to be freed; NULL on failure. A final 0 is added. */
static char *receive(int rank, int *tag, int *size) {
  const struct timespec pause = {.tv_nsec = 100000};
  MPI_Status status;
  int there = 0;
  while (!there) {
    if (MPI_Iprobe(rank, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &status) != MPI_SUCCESS) return NULL;
    if (!there) nanosleep(&pause, NULL);
  }
  *tag = status.MPI_TAG;
  MPI_Get_count(&status, MPI_BYTE, size);
  char *byte = malloc((size_t)*size + 1);
  if (!byte) return NULL;
  byte[*size] = 0;
  if (MPI_Recv(byte, *size, MPI_BYTE, rank, *tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE) == MPI_SUCCESS) return byte;
  free(byte);
  return NULL;
}

/* -- the first process ------------------------------------------------------------------------------ */

static ZpStatus begin(const ZpScenario *scenario, ZpError *err) {
  char *text = NULL;
  size_t length;
  int size;
  FILE *file = open_memstream(&text, &length);
  if (!file) return fail(err, "no memory");
  ZpStatus status = zp_scenario_write(scenario, file, err);
  if (fclose(file) != 0 && status == ZP_OK) status = fail(err, "no memory");
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  for (int rank = FIRST + 1; rank < size && status == ZP_OK; rank++)
    if (MPI_Send(text, (int)length, MPI_BYTE, rank, TAG_SCENARIO, MPI_COMM_WORLD) != MPI_SUCCESS)
      status = fail(err, "a process cannot be reached");
  free(text);
  return status;
}

static ZpStatus compute(void *unused, size_t worker, size_t from, size_t to, unsigned char **byte, size_t *size,
                        ZpError *err) {
  const int rank = FIRST + 1 + (int)worker;
  const unsigned long long cases[2] = {from, to};
  int length = 0, tag;
  (void)unused;
  *byte = NULL;
  if (MPI_Send(cases, 2, MPI_UNSIGNED_LONG_LONG, rank, TAG_CASES, MPI_COMM_WORLD) != MPI_SUCCESS) return ZP_OK;
  char *answer = receive(rank, &tag, &length);
  if (!answer || length == 0) { /* this process is lost */
    free(answer);
    return ZP_OK;
  }
  if (answer[0] != ZP_OK) {
    fail(err, answer + 1);
    free(answer);
    return ZP_MACHINE;
  }
  *size = (size_t)length - 1;
  memmove(answer, answer + 1, *size);
  *byte = (unsigned char *)answer;
  return ZP_OK;
}

static void end_others(int size) {
  const unsigned long long none[2] = {0, 0};
  for (int rank = FIRST + 1; rank < size; rank++)
    MPI_Send(none, 2, MPI_UNSIGNED_LONG_LONG, rank, TAG_CASES, MPI_COMM_WORLD);
}

/* -- the others ------------------------------------------------------------------------------------- */

static void answer(ZpStatus status, const void *byte, size_t size) {
  char *message = malloc(size + 1);
  if (!message || size >= INT_MAX) {
    free(message);
    MPI_Abort(MPI_COMM_WORLD, EXIT_MACHINE);
    return;
  }
  message[0] = (char)status;
  memcpy(message + 1, byte, size);
  MPI_Send(message, (int)size + 1, MPI_BYTE, FIRST, TAG_RESULTS, MPI_COMM_WORLD);
  free(message);
}

static void answer_cases(const ZpScenario *scenario, size_t from, size_t to) {
  const ZpHooks hooks = {.clock = cli_wall_clock};
  ZpError err = {ZP_OK, ""};
  unsigned char *byte = NULL;
  size_t size = 0;
  ZpStatus status = zp_campaign_compute(scenario, from, to, &hooks, &byte, &size, &err);
  if (status == ZP_OK)
    answer(ZP_OK, byte, size);
  else
    answer(ZP_MACHINE, err.message, strlen(err.message) + 1);
  free(byte);
}

/* The scenario of a message; NULL if there is no memory. */
static ZpScenario *read_scenario(const char *text, int size) {
  ZpError err;
  ZpScenario *scenario = zp_scenario_create();
  if (scenario && zp_scenario_parse(scenario, text, (size_t)size, "scenario", &err) == ZP_OK) return scenario;
  zp_scenario_destroy(scenario);
  return NULL;
}

/* Process a message. False if it is the last one. */
static bool heed(const char *message, int tag, int size, ZpScenario **scenario) {
  unsigned long long cases[2];
  if (tag == TAG_SCENARIO) {
    *scenario = read_scenario(message, size);
    return true;
  }
  memcpy(cases, message, sizeof cases);
  if (cases[0] == cases[1]) return false;
  if (*scenario)
    answer_cases(*scenario, (size_t)cases[0], (size_t)cases[1]);
  else
    answer(ZP_MACHINE, "no memory", sizeof "no memory");
  return true;
}

static void serve(void) {
  ZpScenario *scenario = NULL;
  int size, tag;
  bool open = true;
  while (open) {
    char *message = receive(FIRST, &tag, &size);
    open = message && heed(message, tag, size, &scenario);
    free(message);
  }
  zp_scenario_destroy(scenario);
}

int main(int argc, char **argv) {
  int threads, rank, size, status = EXIT_DONE;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_MULTIPLE, &threads);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
  const Crew crew = {size - 1, begin, compute};
  if (threads < MPI_THREAD_MULTIPLE)
    status = cli_fail(&(ZpError){ZP_MACHINE, "this MPI does not allow threads to send messages"});
  else if (rank == FIRST)
    status = cli_main(argc, argv, size > 1 ? &crew : NULL);
  else
    serve();
  if (rank == FIRST) end_others(size);
  MPI_Finalize();
  return status;
}
