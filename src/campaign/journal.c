/* The journal is an SQLite database in WAL mode: a process may be killed at any instant without losing committed rows.
 * With synchronous = FULL each commit is on the disk, so it also survives a loss of power.
 *
 * about(name, value)                                version of the program, number of cases: for people
 * names(id, record)                                 names of numbers, once for all rows with the same (io/packed.h)
 * row(number, hash, outcome, names, record, sum)    a finished case; its record says the outcome, too
 *
 * Records have checksums; `sum` says to which case a record belongs. SQLite has none and would take a bit that a disk
 * has lost for a number. A damaged row does not count and is computed again.
 *
 * Names are written in the transaction of the first row that uses them. */
#include "campaign/journal.h"

#include <sqlite3.h>
#include <stdlib.h>
#include <string.h>

#include <zipact/version.h>

#include "base/fail.h"
#include "base/pack.h"
#include "io/file.h"
#include "study/result.h"

/* "zipa", and the number of this layout. */
enum { APPLICATION = 0x7a697061, LAYOUT = 3 };

/* One thread at a time uses a journal. */
static const int open_flags = SQLITE_OPEN_NOMUTEX;

static const char file_name[] = "journal.sqlite";

/* A record of names, and what it says. */
typedef struct Names {
  sqlite3_int64 id;
  void *record;
  ZpNames names;
} Names;

struct ZpJournal {
  char *path;
  sqlite3 *base;
  sqlite3_stmt *put, *get, *put_names;
  bool open;             /* a transaction */
  bool reading;          /* `get` is at row `at`: one step leads to the next one */
  sqlite3_int64 written; /* id of the names that were written last; 0: none */
  Names *names;          /* [known] of the rows that have been read; results point to them */
  size_t known;
  ZpResult *row; /* row `at`, if has_row; otherwise empty */
  size_t at;
  bool has_row, bad;
};

static ZpStatus fail_base(const ZpJournal *journal, ZpError *err) {
  return zp_fail(err, ZP_MACHINE, "%.300s: %s", journal->path, sqlite3_errmsg(journal->base));
}

static ZpStatus run(ZpJournal *journal, const char *sql, ZpError *err) {
  return sqlite3_exec(journal->base, sql, NULL, NULL, NULL) == SQLITE_OK ? ZP_OK : fail_base(journal, err);
}

/* => the integer result of a query, -1 if it fails. */
static sqlite3_int64 ask(ZpJournal *journal, const char *sql) {
  sqlite3_stmt *query = NULL;
  sqlite3_int64 answer = -1;
  if (sqlite3_prepare_v2(journal->base, sql, -1, &query, NULL) == SQLITE_OK && sqlite3_step(query) == SQLITE_ROW)
    answer = sqlite3_column_int64(query, 0);
  sqlite3_finalize(query);
  return answer;
}

/* -- rows ------------------------------------------------------------------------------------------- */

#define SELECT_ROWS                                                                                                    \
  "SELECT number, hash, row.record, sum, names.id, names.record FROM row JOIN names ON names.id = row.names "          \
  "WHERE number >= ? ORDER BY number"
enum { NUMBER, HASH, RECORD, SUM, NAMES_ID, NAMES };

/* Another number, hash or record has another sum. */
static sqlite3_int64 sum_of(uint64_t number, uint64_t hash, const void *record) {
  static const uint64_t odd = 0x9E3779B97F4A7C15;
  return (sqlite3_int64)((number * odd ^ hash) * odd ^ zp_pack_sum(record));
}

/* The id of names: checksum and size of their record. */
static sqlite3_int64 id_of(const void *record, size_t size) {
  return (sqlite3_int64)((uint64_t)zp_pack_sum(record) << 24 | size);
}

/* Append a record of names, copied. False if it is damaged, or there is no memory. */
static bool add_names(ZpJournal *journal, sqlite3_int64 id, const void *record, size_t size) {
  Names *names = record ? realloc(journal->names, (journal->known + 1) * sizeof *names) : NULL;
  if (!names) return false;
  journal->names = names;
  Names *added = &names[journal->known];
  *added = (Names){.id = id, .record = malloc(size)};
  if (added->record) memcpy(added->record, record, size);
  if (added->record && zp_names_read(added->record, size, &added->names, NULL) == ZP_OK) {
    journal->known++;
    return true;
  }
  free(added->record);
  return false;
}

/* The names of a row of `get`; NULL if they are damaged, or there is no memory. */
static const ZpNames *need_names(ZpJournal *journal) {
  const sqlite3_int64 id = sqlite3_column_int64(journal->get, NAMES_ID);
  for (size_t i = 0; i < journal->known; i++)
    if (journal->names[i].id == id) return &journal->names[i].names;
  const void *record = sqlite3_column_blob(journal->get, NAMES);
  const size_t size = (size_t)sqlite3_column_bytes(journal->get, NAMES);
  return add_names(journal, id, record, size) ? &journal->names[journal->known - 1].names : NULL;
}

/* Read the row of `get` => journal->row. False if it is damaged, or there is no memory. */
static bool read_row(ZpJournal *journal) {
  const uint64_t number = (uint64_t)sqlite3_column_int64(journal->get, NUMBER),
                 hash = (uint64_t)sqlite3_column_int64(journal->get, HASH);
  const ZpNames *names = need_names(journal);
  const void *record = sqlite3_column_blob(journal->get, RECORD);
  const size_t size = (size_t)sqlite3_column_bytes(journal->get, RECORD);
  return names && zp_numbers_read(names, record, size, journal->row, NULL) == ZP_OK &&
         sqlite3_column_int64(journal->get, SUM) == sum_of(number, hash, record);
}

/* -- open and close --------------------------------------------------------------------------------- */

static ZpStatus remove_old(const char *directory, ZpError *err) {
  static const char *const name[] = {"journal.sqlite-wal", "journal.sqlite-shm", "journal.sqlite"};
  ZpStatus status = ZP_OK;
  for (size_t i = 0; i < sizeof name / sizeof name[0] && status == ZP_OK; i++)
    status = zp_remove_file(directory, name[i], err);
  return status;
}

static ZpStatus make_tables(ZpJournal *journal, ZpError *err) {
  char sql[1024];
  snprintf(sql, sizeof sql,
           "BEGIN; PRAGMA application_id = %d; PRAGMA user_version = %d;"
           "CREATE TABLE about(name TEXT PRIMARY KEY, value TEXT) WITHOUT ROWID;"
           "CREATE TABLE names(id INTEGER PRIMARY KEY, record BLOB);"
           "CREATE TABLE row(number INTEGER PRIMARY KEY, hash INTEGER, outcome TEXT, names INTEGER, record BLOB, "
           "sum INTEGER);"
           "INSERT INTO about VALUES('version', '%s'); COMMIT;",
           APPLICATION, LAYOUT, zp_version());
  return run(journal, sql, err);
}

static bool is_journal(ZpJournal *journal) {
  return ask(journal, "PRAGMA application_id") == APPLICATION;
}

/* Of another version: refuse with its name. */
static ZpStatus check_layout(ZpJournal *journal, ZpError *err) {
  sqlite3_stmt *query = NULL;
  if (ask(journal, "PRAGMA user_version") == LAYOUT) return ZP_OK;
  const bool named = sqlite3_prepare_v2(journal->base, "SELECT value FROM about WHERE name = 'version'", -1, &query,
                                        NULL) == SQLITE_OK &&
                     sqlite3_step(query) == SQLITE_ROW;
  ZpStatus status = zp_fail(err, ZP_BAD_INPUT,
                            "%.300s: a journal of zipact %.20s with another layout; start without "
                            "--resume, or continue it with that version",
                            journal->path, named ? (const char *)sqlite3_column_text(query, 0) : "of unknown version");
  sqlite3_finalize(query);
  return status;
}

/* Another program may read the journal at any time: wait for its lock. */
static bool open_file(ZpJournal *journal, int flags) {
  enum { PATIENCE = 10000 }; /* ms */
  const bool open = sqlite3_open_v2(journal->path, &journal->base, open_flags | flags, NULL) == SQLITE_OK;
  if (open) sqlite3_busy_timeout(journal->base, PATIENCE);
  return open;
}

/* The rows of an unfinished campaign took time to compute: only the user may discard them. */
static ZpStatus refuse_unfinished(ZpJournal *journal, ZpError *err) {
  if (!open_file(journal, SQLITE_OPEN_READWRITE) || !is_journal(journal)) return ZP_OK;
  const sqlite3_int64 done = ask(journal, "SELECT count(*) FROM row");
  const sqlite3_int64 cases = ask(journal, "SELECT value FROM about WHERE name = 'cases'");
  if (done <= 0 || done >= cases) return ZP_OK;
  return zp_fail(err, ZP_BAD_INPUT,
                 "%.300s: %lld of %lld cases of an unfinished campaign; give --resume to continue it, delete this file "
                 "to start again, or choose another folder",
                 journal->path, (long long)done, (long long)cases);
}

/* Only an empty file gets our tables. */
static ZpStatus need_tables(ZpJournal *journal, ZpError *err) {
  const sqlite3_int64 tables = ask(journal, "SELECT count(*) FROM sqlite_master");
  if (tables == 0) return make_tables(journal, err);
  if (tables > 0 && is_journal(journal)) return check_layout(journal, err);
  return zp_fail(err, ZP_BAD_INPUT, "%.300s: not a journal of zipact; start without --resume", journal->path);
}

static ZpStatus prepare(ZpJournal *journal, const char *sql, sqlite3_stmt **statement, ZpError *err) {
  const int answer = sqlite3_prepare_v3(journal->base, sql, -1, SQLITE_PREPARE_PERSISTENT, statement, NULL);
  return answer == SQLITE_OK ? ZP_OK : fail_base(journal, err);
}

static ZpStatus prepare_all(ZpJournal *journal, ZpError *err) {
  ZpStatus status = prepare(journal, SELECT_ROWS, &journal->get, err);
  if (status == ZP_OK)
    status = prepare(journal, "INSERT OR REPLACE INTO row VALUES(?, ?, ?, ?, ?, ?)", &journal->put, err);
  return status == ZP_OK ? prepare(journal, "INSERT OR REPLACE INTO names VALUES(?, ?)", &journal->put_names, err)
                         : status;
}

static ZpStatus open_base(ZpJournal *journal, size_t cases, ZpError *err) {
  char sql[160];
  snprintf(sql, sizeof sql, "DELETE FROM row WHERE number >= %zu; INSERT OR REPLACE INTO about VALUES('cases', '%zu')",
           cases, cases);
  if (!open_file(journal, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE))
    return journal->base ? fail_base(journal, err) : zp_fail_memory(err);
  ZpStatus status = need_tables(journal, err);
  if (status == ZP_OK) status = run(journal, "PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL", err);
  if (status == ZP_OK) status = run(journal, sql, err);
  return status == ZP_OK ? prepare_all(journal, err) : status;
}

static ZpJournal *create(const char *path, ZpStudy study) {
  ZpJournal *journal = calloc(1, sizeof *journal);
  if (!journal) return NULL;
  journal->path = path ? strdup(path) : NULL;
  journal->row = zp_result_create(study);
  if (journal->path && journal->row) return journal;
  zp_journal_close(journal);
  return NULL;
}

ZpStatus zp_journal_open(const char *directory, ZpStudy study, bool keep, size_t cases, ZpJournal **out, ZpError *err) {
  char *path = zp_path_join(directory, file_name);
  ZpJournal *journal = *out = create(path, study);
  free(path);
  ZpStatus status = journal ? ZP_OK : zp_fail_memory(err);
  if (status == ZP_OK && !keep) { /* discard the existing one */
    status = refuse_unfinished(journal, err);
    sqlite3_close(journal->base);
    journal->base = NULL;
    if (status == ZP_OK) status = remove_old(directory, err);
  }
  if (status == ZP_OK) status = open_base(journal, cases, err);
  if (status == ZP_OK) return ZP_OK;
  zp_journal_close(journal);
  *out = NULL;
  return status;
}

void zp_journal_close(ZpJournal *journal) {
  if (!journal) return;
  if (journal->open) zp_journal_commit(journal, NULL);
  sqlite3_finalize(journal->put);
  sqlite3_finalize(journal->get);
  sqlite3_finalize(journal->put_names);
  sqlite3_close(journal->base);
  zp_result_destroy(journal->row);
  for (size_t i = 0; i < journal->known; i++)
    free(journal->names[i].record);
  free(journal->names);
  free(journal->path);
  free(journal);
}

/* -- use -------------------------------------------------------------------------------------------- */

static void end_reading(ZpJournal *journal) {
  sqlite3_reset(journal->get);
  journal->reading = false;
}

ZpStatus zp_journal_visit(ZpJournal *journal, void (*visit)(void *user, size_t number, uint64_t hash, bool good),
                          void *user, ZpError *err) {
  int step;
  end_reading(journal);
  journal->has_row = false;
  sqlite3_bind_int64(journal->get, 1, 0);
  while ((step = sqlite3_step(journal->get)) == SQLITE_ROW) {
    const ZpOutcome *outcome = read_row(journal) ? &journal->row->outcome : NULL;
    if (outcome && *outcome != ZP_TIME_LIMIT) /* more time, or another machine, may be enough */
      visit(user, (size_t)sqlite3_column_int64(journal->get, NUMBER),
            (uint64_t)sqlite3_column_int64(journal->get, HASH), zp_outcome_good(*outcome));
  }
  ZpStatus status = step == SQLITE_DONE ? ZP_OK : fail_base(journal, err);
  end_reading(journal);
  return status;
}

/* Run a statement with bound values. */
static ZpStatus finish(ZpJournal *journal, sqlite3_stmt *statement, ZpError *err) {
  const bool done = sqlite3_step(statement) == SQLITE_DONE;
  ZpStatus status = done ? ZP_OK : fail_base(journal, err);
  sqlite3_reset(statement);
  return status;
}

static ZpStatus write_names(ZpJournal *journal, sqlite3_int64 id, const void *record, size_t size, ZpError *err) {
  if (id == journal->written) return ZP_OK;
  sqlite3_bind_int64(journal->put_names, 1, id);
  sqlite3_bind_blob64(journal->put_names, 2, record, size, SQLITE_STATIC);
  journal->written = id;
  return finish(journal, journal->put_names, err);
}

ZpStatus zp_journal_put(ZpJournal *journal, size_t number, uint64_t hash, const ZpPacked *row, ZpError *err) {
  const unsigned char *record = row->byte + row->names;
  const sqlite3_int64 id = id_of(row->byte, row->names);
  end_reading(journal);
  ZpStatus status = journal->open ? ZP_OK : run(journal, "BEGIN", err);
  journal->open = status == ZP_OK;
  if (status == ZP_OK) status = write_names(journal, id, row->byte, row->names, err);
  if (status != ZP_OK) return status;
  sqlite3_bind_int64(journal->put, 1, (sqlite3_int64)number);
  sqlite3_bind_int64(journal->put, 2, (sqlite3_int64)hash);
  sqlite3_bind_text(journal->put, 3, zp_outcome_name(row->outcome), -1, SQLITE_STATIC);
  sqlite3_bind_int64(journal->put, 4, id);
  sqlite3_bind_blob64(journal->put, 5, record, row->size - row->names, SQLITE_STATIC);
  sqlite3_bind_int64(journal->put, 6, sum_of(number, hash, record));
  return finish(journal, journal->put, err);
}

ZpStatus zp_journal_commit(ZpJournal *journal, ZpError *err) {
  if (!journal->open) return ZP_OK;
  journal->open = false;
  return run(journal, "COMMIT", err);
}

ZpStatus zp_journal_finish(ZpJournal *journal, ZpError *err) {
  return run(journal, "UPDATE about SET value = (SELECT count(*) FROM row) WHERE name = 'cases'", err);
}

/* Go to row `number`, one step if the row before it was read last: one transaction then reads all rows. False if there
 * is no such row. */
static bool find_row(ZpJournal *journal, size_t number) {
  if (!journal->reading || number != journal->at + 1) {
    end_reading(journal);
    sqlite3_bind_int64(journal->get, 1, (sqlite3_int64)number);
  }
  journal->at = number;
  journal->reading =
      sqlite3_step(journal->get) == SQLITE_ROW && sqlite3_column_int64(journal->get, NUMBER) == (sqlite3_int64)number;
  if (!journal->reading) end_reading(journal);
  return journal->reading;
}

const ZpResult *zp_journal_get(ZpJournal *journal, size_t number) {
  if (journal->has_row && journal->at == number) return journal->row;
  journal->has_row = find_row(journal, number) && read_row(journal);
  journal->bad = journal->bad || !journal->has_row;
  if (!journal->has_row) zp_result_clear(journal->row);
  return journal->row;
}

ZpStatus zp_journal_status(ZpJournal *journal, ZpError *err) {
  if (!journal->bad) return ZP_OK;
  return zp_fail(err, ZP_MACHINE, "%.300s: a row cannot be read: no memory, or it is damaged", journal->path);
}

/* -- rows for a report ------------------------------------------------------------------------------ */

static const ZpResult *get_row(void *journal, size_t index) {
  return zp_journal_get(journal, index);
}

static ZpStatus get_status(void *journal, ZpError *err) {
  return zp_journal_status(journal, err);
}

static void close_rows(void *journal) {
  zp_journal_close(journal);
}

/* Another reader, which cannot write. */
static bool open_rows(void *user, ZpRows *own) {
  const ZpJournal *journal = user;
  ZpJournal *reader = journal->open ? NULL : create(journal->path, journal->row->study);
  const bool open =
      reader && open_file(reader, SQLITE_OPEN_READONLY) && prepare(reader, SELECT_ROWS, &reader->get, NULL) == ZP_OK;
  *own = (ZpRows){.get = get_row, .status = get_status, .user = reader, .close = close_rows};
  if (!open) zp_journal_close(reader);
  return open;
}

ZpRows zp_journal_rows(ZpJournal *journal) {
  return (ZpRows){.get = get_row, .status = get_status, .user = journal, .open = open_rows};
}
