/* A campaign: worker threads compute the cases, the thread of the caller writes the journal.
 *
 * Threads and not processes: the core has no global state and never ends the process, so separate processes would add
 * no safety. Results need no copies, and an equilibrium takes 0.03 ms, less than a message between processes. If the
 * whole process crashes, the finished rows are in the journal.
 *
 * Workers take chunks of cases (fit/case.h) in the order of their numbers. Rows enter the journal in the order in which
 * they are finished, through a queue of bounded length: a worker waits if it computes faster than the disk writes. The
 * files are written from the journal, row by row in the order of the cases, so neither their bytes nor the memory
 * depend on the number of workers. If a row of a chunk is missing, the chunk is computed from its first case on,
 * because the journal does not have the states of its cases; so are the heads from which it starts. The head of a chunk
 * is its first case, from which those of later chunks of its block start. */
#include <zipact/campaign.h>

#include <errno.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/fail.h"
#include "campaign/case_hash.h"
#include "campaign/journal.h"
#include "def/def.h"
#include "fit/case.h"
#include "io/packed.h"
#include "io/plan.h"
#include "study/result.h"

/* Interval at which the writer wakes; longest time until rows are committed, ms. */
enum { PULSE = 100, COMMIT_AFTER = 500 };

/* Largest number of rows that wait to be written; number of waiting rows that wakes the writer before its PULSE,
 * because a wake-up costs as much as some rows; largest number of cases that another process computes at once. */
enum { QUEUE = 4096, MANY = QUEUE / 8, SPAN_MOST = 64 };
_Static_assert((int)SPAN_MOST >= (int)ZP_CHUNK_MOST, "a span has room for a chunk");

/* State of a row. A row of an earlier process belongs to the same case only if its hash agrees. */
typedef enum Mark { MARK_NONE, MARK_OLD_FAILED, MARK_OLD_GOOD, MARK_FAILED, MARK_GOOD } Mark;

/* A row in the queue to the journal. */
typedef struct Row {
  size_t number;
  uint64_t hash;
  ZpPacked *packed; /* NULL: the journal has this row already */
} Row;

typedef struct Worker {
  ZpCampaign *campaign;
  pthread_t thread;
  size_t number;           /* from 0 */
  _Atomic double fraction; /* progress of the case that it runs, 0 .. 1 */
} Worker;

/* The head of a chunk. */
typedef struct Head {
  ZpResult *result;      /* kept until all chunks of its block are done; NULL: none, or the campaign ends */
  _Atomic uint64_t hash; /* of its row; 0: not known yet */
  enum { HEAD_NONE, HEAD_BUSY, HEAD_DONE } state;
} Head;

/* Cases from .. to - 1. */
typedef struct Span {
  size_t from, to;
} Span;

struct ZpCampaign {
  const ZpScenario *scenario;
  ZpCampaignOptions options;
  ZpJournal *journal;
  ZpRows rows;
  ZpStudy study;
  size_t cases, chunk, span;
  bool keeps_series;
  uint64_t start;      /* zp_campaign_hash */
  uint64_t *hash;      /* [cases] hashes of the rows of an earlier process; 0: none */
  Head *head;          /* [chunks]; NULL: all cases start from scratch */
  unsigned char *mark; /* [cases] a Mark; used by the writer only */
  size_t uncommitted;  /* least number of a row that the journal may still lose; SIZE_MAX: none; the writer's, too */
  ZpCampaignState state;
  atomic_bool stop;
  pthread_mutex_t lock; /* guards the members below */
  pthread_cond_t more, room, heads;
  size_t next;           /* first case that no worker has taken yet */
  size_t *undone;        /* [blocks] chunks that are not done; NULL: no heads */
  size_t first, waiting; /* the queue: a ring */
  Row queue[QUEUE];
  struct {
    Span *span; /* [workers] */
    size_t count;
    size_t busy;  /* spans that other processes compute */
  } lost;         /* cases of lost processes */
  size_t workers; /* number of running workers */
  ZpError err;    /* error of the first worker that failed */
};

/* -- workers ---------------------------------------------------------------------------------------- */

static bool on_progress(void *user, const char *stage, double fraction) {
  Worker *worker = user;
  (void)stage;
  atomic_store(&worker->fraction, fraction);
  return atomic_load(&worker->campaign->stop);
}

static double read_clock(void *user) {
  const ZpCampaignOptions *options = &((const Worker *)user)->campaign->options;
  return options->clock(options->user);
}

static size_t chunks_of(const ZpCampaign *c) {
  return (c->cases + c->chunk - 1) / c->chunk;
}

/* Number of cases that are taken at once: a chunk; several for another process, because messages take time, but few
 * enough that every process has some. */
static size_t span_of(const ZpCampaign *c, size_t workers) {
  enum { SPANS_FEWEST = 8 };
  if (!c->options.remote) return c->chunk;
  const size_t fair = c->cases / (SPANS_FEWEST * workers), most = fair < SPAN_MOST ? fair : SPAN_MOST;
  return most > c->chunk ? most / c->chunk * c->chunk : c->chunk;
}

/* The next cases *from .. *to - 1, first those of a lost process; false if there are none. While a process that may be
 * lost computes the last cases, the other workers wait; the writer wakes them from time to time. */
static bool take_chunk(ZpCampaign *c, size_t *from, size_t *to) {
  pthread_mutex_lock(&c->lock);
  while (c->next == c->cases && c->lost.count == 0 && c->lost.busy > 0 && !atomic_load(&c->stop))
    pthread_cond_wait(&c->room, &c->lock);
  if (c->lost.count > 0) {
    const Span span = c->lost.span[--c->lost.count];
    *from = span.from;
    *to = span.to;
  } else {
    *from = c->next;
    *to = c->cases - c->next < c->span ? c->cases : c->next + c->span;
    c->next = *to;
  }
  c->lost.busy += c->options.remote && *from < *to;
  pthread_mutex_unlock(&c->lock);
  return *from < *to && !atomic_load(&c->stop);
}

/* The cases of another process are done or lost; in the latter case other workers compute them. A worker that loses its
 * process takes no more cases, so the list has room. */
static void end_span(ZpCampaign *c, size_t from, size_t to, bool lost) {
  pthread_mutex_lock(&c->lock);
  if (lost) c->lost.span[c->lost.count++] = (Span){from, to};
  c->lost.busy--;
  pthread_cond_broadcast(&c->room);
  pthread_mutex_unlock(&c->lock);
}

static void hand_over(ZpCampaign *c, size_t number, uint64_t hash, ZpPacked *packed) {
  pthread_mutex_lock(&c->lock);
  while (c->waiting == QUEUE)
    pthread_cond_wait(&c->room, &c->lock);
  c->queue[(c->first + c->waiting++) % QUEUE] = (Row){number, hash, packed};
  if (c->waiting == MANY) pthread_cond_signal(&c->more);
  pthread_mutex_unlock(&c->lock);
}

static void fail(ZpCampaign *c, const ZpError *err) {
  pthread_mutex_lock(&c->lock);
  if (c->err.status == ZP_OK) c->err = *err;
  pthread_mutex_unlock(&c->lock);
  atomic_store(&c->stop, true);
}

/* A result is sent to the journal as bytes: there are many results, and no thread has to free the memory of another. */
static void hand_over_result(ZpCampaign *c, size_t number, uint64_t hash, const ZpResult *result) {
  ZpPacked *packed = zp_packed_of(result);
  if (packed)
    hand_over(c, number, hash, packed);
  else
    fail(c, &(ZpError){ZP_MACHINE, "no memory"});
}

/* => the result, NULL if the campaign ends: stopped, or the machine failed. A case that ends after the stop is dropped,
 * because its estimated errors may be missing. */
static ZpResult *run_case(Worker *worker, size_t number, const ZpResult *neighbour) {
  ZpCampaign *c = worker->campaign;
  const ZpHooks hooks = {worker, on_progress, c->options.clock ? read_clock : NULL};
  ZpResult *result = NULL;
  ZpError err;
  ZpStatus status = zp_case_run_or_say(c->scenario, number, neighbour, &hooks, &result, &err);
  atomic_store(&worker->fraction, 0);
  if (status != ZP_OK) {
    fail(c, &err);
    return NULL;
  }
  if (result->outcome != ZP_INTERRUPTED && !atomic_load(&c->stop)) return result;
  zp_result_destroy(result);
  return NULL;
}

static void drop_series(ZpResult *result) {
  zp_table_destroy(result->series);
  result->series = NULL;
}

/* -- heads ------------------------------------------------------------------------------------------ */

/* Wait until no other worker computes this head. True if the caller must compute it. */
static bool take_head(ZpCampaign *c, Head *head) {
  pthread_mutex_lock(&c->lock);
  while (head->state == HEAD_BUSY)
    pthread_cond_wait(&c->heads, &c->lock);
  const bool taken = head->state == HEAD_NONE;
  if (taken) head->state = HEAD_BUSY;
  pthread_mutex_unlock(&c->lock);
  return taken;
}

static void end_head(ZpCampaign *c, Head *head, ZpResult *result) {
  pthread_mutex_lock(&c->lock);
  head->result = result;
  head->state = HEAD_DONE;
  pthread_cond_broadcast(&c->heads);
  pthread_mutex_unlock(&c->lock);
}

/* The head with this number, which may wait for those from which it starts. NULL if the campaign ends. */
static const ZpResult *head_of(Worker *worker, size_t number) {
  ZpCampaign *c = worker->campaign;
  Head *head = &c->head[number / c->chunk];
  if (!take_head(c, head)) return head->result;
  const size_t neighbour = zp_case_neighbour(c->scenario, number);
  const ZpResult *from = neighbour < number ? head_of(worker, neighbour) : NULL;
  ZpResult *result = from || neighbour == number ? run_case(worker, number, from) : NULL;
  if (result && !c->keeps_series) drop_series(result);
  end_head(c, head, result);
  return result;
}

static void drop_heads(ZpCampaign *c, size_t block) {
  const size_t chunks = chunks_of(c), first = block * ZP_BLOCK_CHUNKS;
  for (size_t k = first; k < first + ZP_BLOCK_CHUNKS && k < chunks; k++) {
    zp_result_destroy(c->head[k].result);
    c->head[k].result = NULL;
  }
}

/* Chunks of the cases from .. to - 1 are done. The last one of a block drops its heads. */
static void end_chunks(ZpCampaign *c, size_t from, size_t to) {
  for (size_t i = from; c->head && i < to; i += c->chunk) {
    const size_t block = i / c->chunk / ZP_BLOCK_CHUNKS;
    pthread_mutex_lock(&c->lock);
    const bool last = --c->undone[block] == 0;
    pthread_mutex_unlock(&c->lock);
    if (last) drop_heads(c, block);
  }
}

/* False if there is no memory. */
static bool create_heads(ZpCampaign *c) {
  if (!zp_study_follows(c->study)) return true;
  const size_t chunks = chunks_of(c), blocks = (chunks + ZP_BLOCK_CHUNKS - 1) / ZP_BLOCK_CHUNKS;
  c->head = calloc(chunks, sizeof *c->head);
  c->undone = calloc(blocks, sizeof *c->undone);
  for (size_t k = 0; c->undone && k < chunks; k++)
    c->undone[k / ZP_BLOCK_CHUNKS]++;
  return c->head && c->undone;
}

/* -- spans ------------------------------------------------------------------------------------------ */

/* The hash of a case that follows one with the hash `before`. *resolved: are its keys possible? If not, the run reports
 * the reason, and the hash is the same. */
static uint64_t hash_after(const ZpCampaign *c, size_t number, uint64_t before, bool *resolved) {
  ZpActuatorDef def = {0};
  *resolved = zp_scenario_given(c->scenario, number, &def, NULL) == ZP_OK;
  const uint64_t hash = *resolved ? zp_case_hash(before, &def) : before;
  zp_def_clear(&def);
  return hash;
}

/* The hash of the first case of a chunk, after that of the head from which it starts. */
static uint64_t hash_of_first(const ZpCampaign *c, size_t number, bool *resolved) {
  const size_t neighbour = zp_case_neighbour(c->scenario, number);
  if (neighbour == number) return hash_after(c, number, c->start, resolved);
  Head *from = &c->head[neighbour / c->chunk];
  uint64_t before = atomic_load(&from->hash);
  if (before == 0) before = hash_of_first(c, neighbour, resolved);
  atomic_store(&from->hash, before);
  return hash_after(c, number, before, resolved);
}

/* Compute the hashes of the cases from .. to - 1, of whole chunks. True if the journal has all of them. */
static bool hash_cases(const ZpCampaign *c, size_t from, size_t to, uint64_t hash[SPAN_MOST]) {
  bool known = true, resolved;
  for (size_t i = from; i < to; i++) {
    const bool first = (i - from) % c->chunk == 0;
    hash[i - from] = first ? hash_of_first(c, i, &resolved) : hash_after(c, i, hash[i - from - 1], &resolved);
    known = known && resolved && c->hash[i] == hash[i - from];
  }
  return known;
}

/* The results of cases from .. to - 1 from which others may start yet. */
typedef struct Kept {
  size_t from;
  ZpResult *result[SPAN_MOST];
} Kept;

/* Compute a chunk. A result is sent to the writer when the last one of the chunk that starts from it is finished. */
static void run_chunk(Worker *worker, size_t from, size_t to, const uint64_t *hash) {
  ZpCampaign *c = worker->campaign;
  Kept kept = {.from = from};
  size_t last[SPAN_MOST];
  const ZpResult *head = c->head ? head_of(worker, from) : NULL;
  bool runs = head || !c->head;
  if (head) hand_over_result(c, from, hash[0], head);
  zp_case_last(c->scenario, from, to, last);
  for (size_t i = from + (head != NULL); i < to && runs; i++) {
    const size_t neighbour = zp_case_neighbour(c->scenario, i);
    const ZpResult *start = neighbour == i ? NULL : neighbour == from ? head : kept.result[neighbour - from];
    ZpResult *result = kept.result[i - from] = run_case(worker, i, start);
    runs = result != NULL;
    if (runs && !c->keeps_series) drop_series(result);
    for (size_t k = from; k <= i; k++) {
      ZpResult **done = &kept.result[k - from];
      if (!*done || (runs && last[k - from] > i)) continue;
      hand_over_result(c, k, hash[k - from], *done);
      zp_result_destroy(*done);
      *done = NULL;
    }
  }
}

/* Send the results of cases that another process has computed to the writer. False if it is lost. */
static bool run_elsewhere(Worker *worker, size_t from, size_t to, const uint64_t *hash) {
  ZpCampaign *c = worker->campaign;
  ZpResult *result[SPAN_MOST] = {NULL};
  unsigned char *byte = NULL;
  size_t size = 0;
  ZpError err = {ZP_MACHINE, "results of another process cannot be read: no memory, or another version"};
  ZpStatus status = c->options.remote(c->options.remote_user, worker->number, from, to, &byte, &size, &err);
  const bool lost = status == ZP_OK && !byte;
  if (status == ZP_OK && byte && !zp_results_read(byte, size, c->study, to - from, result)) status = ZP_MACHINE;
  if (status != ZP_OK) fail(c, &err);
  for (size_t i = from; i < to && status == ZP_OK && !lost; i++) {
    hand_over_result(c, i, hash[i - from], result[i - from]);
    zp_result_destroy(result[i - from]);
  }
  free(byte); /* which has the names of the results */
  return !lost;
}

/* False if the worker takes no more cases. */
static bool run_span(Worker *worker, size_t from, size_t to) {
  ZpCampaign *c = worker->campaign;
  uint64_t hash[SPAN_MOST];
  const bool known = hash_cases(c, from, to, hash);
  bool lost = false;
  for (size_t i = from; known && i < to; i++)
    hand_over(c, i, hash[i - from], NULL);
  if (!known && c->options.remote)
    lost = !run_elsewhere(worker, from, to, hash);
  else if (!known)
    run_chunk(worker, from, to, hash);
  end_chunks(c, from, to);
  if (c->options.remote) end_span(c, from, to, lost);
  return !lost;
}

static void *work(void *user) {
  Worker *worker = user;
  ZpCampaign *c = worker->campaign;
  size_t from, to;
  while (take_chunk(c, &from, &to) && run_span(worker, from, to))
    continue;
  pthread_mutex_lock(&c->lock);
  c->workers--;
  pthread_cond_signal(&c->more);
  pthread_mutex_unlock(&c->lock);
  return NULL;
}

/* -- the writer ------------------------------------------------------------------------------------- */

/* ms */
static double now(void) {
  struct timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  return 1e3 * (double)time.tv_sec + 1e-6 * (double)time.tv_nsec;
}

/* Wait at most a PULSE for many rows, and take those that are in the queue => their number; *open is false after the
 * last one. */
static size_t take_rows(ZpCampaign *c, Row row[QUEUE], bool *open) {
  struct timespec end;
  clock_gettime(CLOCK_MONOTONIC, &end);
  end.tv_nsec += PULSE * 1000000L;
  end.tv_sec += end.tv_nsec / 1000000000L;
  end.tv_nsec %= 1000000000L;
  pthread_mutex_lock(&c->lock);
  for (int late = 0; c->waiting < MANY && c->workers > 0 && !late;)
    late = pthread_cond_timedwait(&c->more, &c->lock, &end);
  const size_t count = c->waiting;
  for (size_t i = 0; i < count; i++)
    row[i] = c->queue[(c->first + i) % QUEUE];
  c->first = (c->first + count) % QUEUE;
  c->waiting = 0;
  *open = c->workers > 0 || count > 0;
  pthread_cond_broadcast(&c->room);
  pthread_mutex_unlock(&c->lock);
  return count;
}

static ZpStatus write_row(ZpCampaign *c, const Row *row, ZpError *err) {
  unsigned char *mark = &c->mark[row->number];
  bool good = *mark == MARK_OLD_GOOD;
  if (row->packed) {
    if (row->number < c->uncommitted) c->uncommitted = row->number;
    ZpStatus status = zp_journal_put(c->journal, row->number, row->hash, row->packed, err);
    if (status != ZP_OK) return status;
    good = zp_outcome_good(row->packed->outcome);
  }
  *mark = good ? MARK_GOOD : MARK_FAILED;
  c->state.done++;
  c->state.resumed += row->packed == NULL;
  c->state.failed += !good;
  return ZP_OK;
}

/* Write rows; after an error, only free them. */
static ZpStatus write_rows(ZpCampaign *c, const Row *row, size_t count, ZpStatus status, ZpError *err) {
  for (size_t i = 0; i < count; i++) {
    if (status == ZP_OK) status = write_row(c, &row[i], err);
    free(row[i].packed);
  }
  return status;
}

static void look_around(ZpCampaign *c, const Worker *worker, size_t workers) {
  double done = (double)c->state.done;
  for (size_t i = 0; i < workers; i++)
    done += atomic_load(&worker[i].fraction);
  c->state.fraction = done / (double)c->cases;
  if (c->options.progress && c->options.progress(c->options.user, &c->state)) atomic_store(&c->stop, true);
}

/* Write rows until the workers have ended. */
static ZpStatus write_all(ZpCampaign *c, const Worker *worker, size_t workers, ZpError *err) {
  ZpStatus status = ZP_OK;
  Row row[QUEUE];
  double committed = now(), looked = 0;
  for (bool open = true; open;) {
    const size_t count = take_rows(c, row, &open);
    status = write_rows(c, row, count, status, err);
    const bool due = now() - committed >= COMMIT_AFTER || !open;
    if (due) committed = now();
    if (due && status == ZP_OK) {
      status = zp_journal_commit(c->journal, err);
      if (status == ZP_OK) c->uncommitted = SIZE_MAX;
    }
    if (status != ZP_OK) atomic_store(&c->stop, true);
    if (now() - looked < PULSE && open) continue;
    looked = now();
    look_around(c, worker, workers);
  }
  return status;
}

/* -- a campaign ------------------------------------------------------------------------------------- */

/* Start the workers => their number. If threads are not available, fewer run. */
static size_t start_workers(ZpCampaign *c, Worker *worker, size_t most) {
  c->workers = most;
  size_t started = 0;
  for (; started < most; started++) {
    worker[started].campaign = c;
    worker[started].number = started;
    if (pthread_create(&worker[started].thread, NULL, work, &worker[started]) != 0) break;
  }
  pthread_mutex_lock(&c->lock);
  c->workers -= most - started;
  pthread_mutex_unlock(&c->lock);
  return started;
}

ZpStatus zp_campaign_run(ZpCampaign *c, ZpError *err) {
  const size_t jobs = (size_t)(c->options.jobs > 0 ? c->options.jobs : zp_processors());
  const size_t chunks = chunks_of(c), most = jobs < chunks ? jobs : chunks;
  Worker *worker = calloc(most, sizeof *worker);
  free(c->lost.span);
  c->lost.span = calloc(most, sizeof *c->lost.span);
  c->span = span_of(c, most);
  if (!worker || !c->lost.span) {
    free(worker);
    return zp_fail_memory(err);
  }
  const size_t workers = start_workers(c, worker, most);
  ZpStatus status = workers > 0 ? ZP_OK : zp_fail(err, ZP_MACHINE, "no thread could be started");
  if (workers > 0) status = write_all(c, worker, workers, err);
  for (size_t i = 0; i < workers; i++)
    pthread_join(worker[i].thread, NULL);
  free(worker);
  if (status == ZP_OK && c->lost.count > 0)
    status = zp_fail(err, ZP_MACHINE,
                     "a process ended before it returned all its cases; --resume computes the missing ones");
  return status == ZP_OK && c->err.status != ZP_OK ? zp_fail(err, c->err.status, "%s", c->err.message) : status;
}

static void take_old_row(void *user, size_t number, uint64_t hash, bool good) {
  ZpCampaign *c = user;
  if (number >= c->cases) return;
  c->hash[number] = hash;
  c->mark[number] = good ? MARK_OLD_GOOD : MARK_OLD_FAILED;
}

/* -- open and close --------------------------------------------------------------------------------- */

/* A campaign that can be closed; NULL if there is no memory. */
static ZpCampaign *create(void) {
  pthread_condattr_t attributes;
  ZpCampaign *c = calloc(1, sizeof *c);
  if (c && pthread_mutex_init(&c->lock, NULL) == 0 && pthread_cond_init(&c->room, NULL) == 0 &&
      pthread_cond_init(&c->heads, NULL) == 0 && pthread_condattr_init(&attributes) == 0 &&
      pthread_condattr_setclock(&attributes, CLOCK_MONOTONIC) == 0 && pthread_cond_init(&c->more, &attributes) == 0)
    return c;
  free(c);
  return NULL;
}

static ZpStatus open_campaign(ZpCampaign *c, const char *directory, ZpError *err) {
  ZpActuatorDef def = {0};
  ZpStatus status = zp_scenario_def(c->scenario, 0, &def, err);
  if (status == ZP_OK) status = zp_campaign_hash(c->study, &def, &c->start, err);
  zp_def_clear(&def);
  if (status == ZP_OK) status = zp_journal_open(directory, c->study, c->options.resume, c->cases, &c->journal, err);
  c->rows = zp_journal_rows(c->journal);
  return status == ZP_OK ? zp_journal_visit(c->journal, take_old_row, c, err) : status;
}

ZpStatus zp_campaign_open(const ZpScenario *scenario, const char *directory, const ZpCampaignOptions *options,
                          ZpCampaign **out, ZpError *err) {
  ZpCampaign *c = *out = create();
  if (!c) return zp_fail_memory(err);
  c->scenario = scenario;
  c->options = *options;
  c->study = zp_scenario_study(scenario);
  c->cases = c->state.cases = zp_scenario_count(scenario);
  c->chunk = zp_case_chunk(scenario);
  c->keeps_series = zp_scenario_keeps_series(scenario);
  c->uncommitted = SIZE_MAX;
  c->hash = calloc(c->cases, sizeof *c->hash);
  c->mark = calloc(c->cases, sizeof *c->mark);
  ZpStatus status = c->hash && c->mark && create_heads(c) ? open_campaign(c, directory, err) : zp_fail_memory(err);
  if (status == ZP_OK) return ZP_OK;
  zp_campaign_close(c);
  *out = NULL;
  return status;
}

ZpCampaignState zp_campaign_state(const ZpCampaign *campaign) {
  return campaign->state;
}

size_t zp_campaign_count(const ZpCampaign *campaign) {
  const size_t most = campaign->cases < campaign->uncommitted ? campaign->cases : campaign->uncommitted;
  size_t count = 0;
  while (count < most && campaign->mark[count] >= MARK_FAILED)
    count++;
  return count;
}

const ZpRows *zp_campaign_rows(const ZpCampaign *campaign) {
  return &campaign->rows;
}

void zp_campaign_close(ZpCampaign *c) {
  if (!c) return;
  zp_journal_close(c->journal);
  pthread_mutex_destroy(&c->lock);
  pthread_cond_destroy(&c->more);
  pthread_cond_destroy(&c->room);
  pthread_cond_destroy(&c->heads);
  for (size_t k = 0; c->head && k < chunks_of(c); k++)
    zp_result_destroy(c->head[k].result);
  free(c->head);
  free(c->undone);
  free(c->lost.span);
  free(c->hash);
  free(c->mark);
  free(c);
}

/* -- the process that computes them; the bytes of each result follow those of the one before --------- */

/* Append a result. False if there is no memory. */
static bool put_result(FILE *out, const ZpResult *result) {
  ZpPacked *packed = zp_packed_of(result);
  const bool put = packed && fwrite(packed->byte, 1, packed->size, out) == packed->size;
  free(packed);
  return put;
}

/* The result from which case `number` starts, of a head that is not `kept`, and *made, to be destroyed: that head is
 * computed, and so are those from which it starts itself. NULL: it starts from scratch, or *status says why not. */
static const ZpResult *start_of(const ZpScenario *scenario, const Kept *kept, size_t number, const ZpHooks *hooks,
                                ZpResult **made, ZpStatus *status, ZpError *err) {
  const size_t neighbour = zp_case_neighbour(scenario, number);
  *made = NULL;
  if (neighbour == number) return NULL;
  if (neighbour >= kept->from) return kept->result[neighbour - kept->from];
  ZpResult *before;
  const ZpResult *start = start_of(scenario, kept, neighbour, hooks, &before, status, err);
  if (*status == ZP_OK) *status = zp_case_run_or_say(scenario, neighbour, start, hooks, made, err);
  zp_result_destroy(before);
  return *made;
}

/* Run the cases one after the other and append their results. */
static ZpStatus compute_all(const ZpScenario *scenario, size_t from, size_t to, const ZpHooks *hooks, FILE *out,
                            ZpError *err) {
  Kept kept = {.from = from};
  ZpStatus status = ZP_OK;
  const bool keeps_series = zp_scenario_keeps_series(scenario);
  for (size_t i = from; i < to && status == ZP_OK; i++) {
    ZpResult **result = &kept.result[i - from], *made;
    const ZpResult *start = start_of(scenario, &kept, i, hooks, &made, &status, err);
    if (status == ZP_OK) status = zp_case_run_or_say(scenario, i, start, hooks, result, err);
    zp_result_destroy(made);
    if (status != ZP_OK) break;
    if (!keeps_series) drop_series(*result);
    if (!put_result(out, *result)) status = zp_fail_memory(err);
  }
  for (size_t i = from; i < to; i++)
    zp_result_destroy(kept.result[i - from]);
  return status;
}

ZpStatus zp_campaign_compute(const ZpScenario *scenario, size_t from, size_t to, const ZpHooks *hooks,
                             unsigned char **byte, size_t *size, ZpError *err) {
  char *results = NULL;
  *byte = NULL;
  FILE *out = open_memstream(&results, size);
  if (!out) return zp_fail_memory(err);
  ZpStatus status = compute_all(scenario, from, to, hooks, out, err);
  if (fclose(out) != 0 && status == ZP_OK) status = zp_fail_memory(err);
  if (status == ZP_OK)
    *byte = (unsigned char *)results;
  else
    free(results);
  return status;
}
