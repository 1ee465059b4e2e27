/* The program zipact-mpi: the first process does what zipact does, except that the other processes compute the cases of
 * a sweep.
 *
 * The first process has a thread per other process, which sends it some cases and waits. The others receive the
 * scenario in a message, so that only the first process reads it; all processes must find the files that keys name.
 * Waiting processes poll for messages: the waiting of MPI itself would occupy a processor each.
 *
 * MPI does not say that a process has died, so the first process and all that compute send a sign of life every
 * second. A process that has been silent for SILENT_MOST seconds is lost, and others compute its cases (if mpirun keeps
 * them: --enable-recovery). MPI_Finalize would wait for it, so the others end without. */
#include <mpi.h>

#include <limits.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "cli.h"

enum { FIRST = 0, SILENT_MOST = 10 };

/* Messages: a scenario as YAML; cases from .. to - 1; their results after a byte for the status, or the message of an
 * error; a sign of life, nothing; a call, nothing, to be answered by another; the end, with 1 if a process is lost. */
enum { TAG_SCENARIO = 1, TAG_CASES, TAG_RESULTS, TAG_ALIVE, TAG_CALL, TAG_END };

static ZpStatus fail(ZpError *err, const char *message) {
  *err = (ZpError){.status = ZP_MACHINE};
  snprintf(err->message, sizeof err->message, "%.500s", message);
  return ZP_MACHINE;
}

static void pause_shortly(void) {
  const struct timespec pause = {.tv_nsec = 100000};
  nanosleep(&pause, NULL);
}

/* False if the process does not take the message in SILENT_MOST seconds; MPI may then still read it. */
// NOLINTBEGIN(clang-analyzer-optin.mpi.MPI-Checker): MPI_Test waits for the request; that of a lost process never ends
static bool send(const void *byte, size_t size, int rank, int tag) {
  const double start = cli_wall_clock(NULL);
  MPI_Request request;
  int sent = 0;
  if (size > INT_MAX) return false;
  if (MPI_Isend(byte, (int)size, MPI_BYTE, rank, tag, MPI_COMM_WORLD, &request) != MPI_SUCCESS) return false;
  while (MPI_Test(&request, &sent, MPI_STATUS_IGNORE) == MPI_SUCCESS && !sent &&
         cli_wall_clock(NULL) - start < SILENT_MOST)
    pause_shortly();
  return sent;
}
// NOLINTEND(clang-analyzer-optin.mpi.MPI-Checker)

/* Receive the next message of a process, of any length, to be freed; NULL if that fails or none comes in
 * SILENT_MOST seconds. One byte longer, 0. */
static char *receive(int rank, int *tag, int *size) {
  const double start = cli_wall_clock(NULL);
  MPI_Status status;
  int there = 0;
  while (!there) {
    if (MPI_Iprobe(rank, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &status) != MPI_SUCCESS) return NULL;
    if (there) break;
    if (cli_wall_clock(NULL) - start > SILENT_MOST) return NULL;
    pause_shortly();
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

/* The next message of a process that is no sign of life, to be freed; NULL if the process is lost. */
static char *receive_next(int rank, int *tag, int *size) {
  char *message = receive(rank, tag, size);
  while (message && *tag == TAG_ALIVE) {
    free(message);
    message = receive(rank, tag, size);
  }
  return message;
}

/* -- signs of life ---------------------------------------------------------------------------------- */

typedef struct Beat {
  int from, to;            /* processes that are told: from .. to - 1 */
  const atomic_bool *lost; /* [to] those that are not, since they are lost; NULL: none is */
  pthread_t thread;
  pthread_mutex_t lock;
  pthread_cond_t ends;
  bool ended;
} Beat;

static void *beat(void *self) {
  Beat *b = self;
  struct timespec next;
  clock_gettime(CLOCK_REALTIME, &next);
  pthread_mutex_lock(&b->lock);
  while (!b->ended) {
    next.tv_sec++;
    while (!b->ended && pthread_cond_timedwait(&b->ends, &b->lock, &next) == 0) {
    }
    for (int rank = b->from; rank < b->to && !b->ended; rank++)
      if (!b->lost || !atomic_load(&b->lost[rank])) MPI_Send(NULL, 0, MPI_BYTE, rank, TAG_ALIVE, MPI_COMM_WORLD);
  }
  pthread_mutex_unlock(&b->lock);
  return NULL;
}

/* False if there is no thread for it: then messages must come in SILENT_MOST seconds. */
static bool start_beat(Beat *b, int from, int to, const atomic_bool *lost) {
  *b = (Beat){.from = from, .to = to, .lost = lost};
  pthread_mutex_init(&b->lock, NULL);
  pthread_cond_init(&b->ends, NULL);
  return pthread_create(&b->thread, NULL, beat, b) == 0;
}

static void end_beat(Beat *b, bool started) {
  pthread_mutex_lock(&b->lock);
  b->ended = true;
  pthread_cond_signal(&b->ends);
  pthread_mutex_unlock(&b->lock);
  if (started) pthread_join(b->thread, NULL);
  pthread_cond_destroy(&b->ends);
  pthread_mutex_destroy(&b->lock);
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
    if (!send(text, length, rank, TAG_SCENARIO)) status = fail(err, "a process cannot be reached");
  free(text);
  return status;
}

static void say_lost(int rank) {
  char text[128];
  snprintf(text, sizeof text, "process %d of the job is lost; the others compute its cases", rank);
  cli_notice(text);
}

static ZpStatus compute(void *lost, size_t worker, size_t from, size_t to, unsigned char **byte, size_t *size,
                        ZpError *err) {
  const int rank = FIRST + 1 + (int)worker;
  const unsigned long long cases[2] = {from, to};
  int length = 0, tag;
  *byte = NULL;
  bool sent = send(cases, sizeof cases, rank, TAG_CASES);
  char *answer = sent ? receive_next(rank, &tag, &length) : NULL;
  if (!answer || length == 0) {
    atomic_store(&((atomic_bool *)lost)[rank], true);
    say_lost(rank);
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

/* Does a process that computes nothing answer? */
static bool is_there(int rank) {
  int tag, size;
  MPI_Send(NULL, 0, MPI_BYTE, rank, TAG_CALL, MPI_COMM_WORLD);
  char *message = receive_next(rank, &tag, &size);
  free(message);
  return message != NULL;
}

/* => is one of them lost? */
static bool end_others(int size, const atomic_bool *lost) {
  char any = 0;
  for (int rank = FIRST + 1; rank < size; rank++)
    any = any || atomic_load(&lost[rank]) || !is_there(rank);
  for (int rank = FIRST + 1; rank < size; rank++)
    MPI_Send(&any, 1, MPI_BYTE, rank, TAG_END, MPI_COMM_WORLD);
  return any;
}

/* => is another process lost? */
static bool lead(int argc, char **argv, int size, int *status) {
  atomic_bool *lost = calloc((size_t)size, sizeof *lost);
  if (!lost) MPI_Abort(MPI_COMM_WORLD, EXIT_MACHINE);
  const Crew crew = {size - 1, begin, compute, lost};
  Beat life;
  bool beats = start_beat(&life, FIRST + 1, size, lost);
  *status = cli_main(argc, argv, size > 1 ? &crew : NULL);
  bool any = end_others(size, lost);
  end_beat(&life, beats);
  free(lost);
  return any;
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
  if (send(message, size + 1, FIRST, TAG_RESULTS)) free(message);
} // NOLINT(clang-analyzer-unix.Malloc): MPI may still read a message that was not sent

static void answer_cases(const ZpScenario *scenario, size_t from, size_t to) {
  const ZpHooks hooks = {.clock = cli_wall_clock};
  ZpError err = {ZP_OK, ""};
  unsigned char *byte = NULL;
  size_t size = 0;
  Beat life;
  bool beats = start_beat(&life, FIRST, FIRST + 1, NULL);
  ZpStatus status = zp_campaign_compute(scenario, from, to, &hooks, &byte, &size, &err);
  end_beat(&life, beats);
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

static void compute_for_first(const ZpScenario *scenario, const char *message) {
  unsigned long long cases[2];
  memcpy(cases, message, sizeof cases);
  if (scenario)
    answer_cases(scenario, (size_t)cases[0], (size_t)cases[1]);
  else
    answer(ZP_MACHINE, "no memory", sizeof "no memory");
}

/* Do what the messages of the first say, until the last => is a process lost? If that is the first, the job fails. */
static bool serve(int *status) {
  ZpScenario *scenario = NULL;
  int size, tag = TAG_ALIVE;
  bool lost = false;
  while (tag != TAG_END && !lost) {
    char *message = receive_next(FIRST, &tag, &size);
    if (message && tag == TAG_SCENARIO) scenario = read_scenario(message, size);
    if (message && tag == TAG_CASES) compute_for_first(scenario, message);
    if (message && tag == TAG_CALL) MPI_Send(NULL, 0, MPI_BYTE, FIRST, TAG_CALL, MPI_COMM_WORLD);
    if (!message) *status = EXIT_MACHINE;
    lost = !message || (tag == TAG_END && message[0]);
    free(message);
  }
  zp_scenario_destroy(scenario);
  return lost;
}

int main(int argc, char **argv) {
  int threads, rank, size, status = EXIT_DONE;
  bool lost = false;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_MULTIPLE, &threads);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
  if (threads < MPI_THREAD_MULTIPLE)
    status = cli_fail(&(ZpError){ZP_MACHINE, "this MPI does not allow threads to send messages"});
  else if (rank == FIRST)
    lost = lead(argc, argv, size, &status);
  else
    lost = serve(&status);
  if (!lost) MPI_Finalize();
  return status;
}
