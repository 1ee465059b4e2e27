/* The journal is an SQLite database in WAL mode: a process may be killed at any instant without losing committed rows.
 * With synchronous = FULL each commit is on the disk, so it also survives a loss of power.
 *
 * about(name, value)                            version of the program, study, number of cases: for people
 * name(id, name, unit, help, timing)            names of scalars and columns, once for all rows
 * row(number, hash, outcome, message, result)   a finished case; result: record.c
 *
 * Names are written in the transaction of the first row that uses them. The threads that compute the rows also pack
 * them, so the ids of names depend on their order; the results that are read do not. */
#include "campaign/journal.h"

#include <pthread.h>
#include <sqlite3.h>
#include <stdlib.h>
#include <string.h>

#include "base/fail.h"
#include "campaign/record.h"
#include "io/atomic.h"

/* "zipa", and the number of this layout. */
enum { APPLICATION = 0x7a697061, LAYOUT = 1 };

/* One thread at a time uses a journal. */
static const int open_flags = SQLITE_OPEN_NOMUTEX;

static const char file_name[] = "journal.sqlite";

struct ZpJournal {
  char *path;
  sqlite3 *base;
  sqlite3_stmt *put, *get, *put_name;
  bool open;            /* a transaction */
  bool reading;         /* `get` is at row `at`: one step leads to the next one */
  pthread_mutex_t lock; /* guards names and record while rows are packed */
  ZpNames names;
  size_t names_written;
  ZpRecord record;
  ZpResult row; /* result of zp_journal_get: row `at` */
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
           "CREATE TABLE name(id INTEGER PRIMARY KEY, name TEXT, unit TEXT, help TEXT, timing INTEGER);"
           "CREATE TABLE row(number INTEGER PRIMARY KEY, hash INTEGER, outcome TEXT, message TEXT, result BLOB);"
           "INSERT INTO about VALUES('version', '%s'); COMMIT;",
           APPLICATION, LAYOUT, zp_version());
  return run(journal, sql, err);
}

static bool is_ours(ZpJournal *journal) {
  return ask(journal, "PRAGMA application_id") == APPLICATION && ask(journal, "PRAGMA user_version") == LAYOUT;
}

/* The rows of an unfinished campaign took time to compute: only the user may discard them. */
static ZpStatus refuse_unfinished(ZpJournal *journal, ZpError *err) {
  if (sqlite3_open_v2(journal->path, &journal->base, open_flags | SQLITE_OPEN_READWRITE, NULL) != SQLITE_OK ||
      !is_ours(journal))
    return ZP_OK;
  const sqlite3_int64 done = ask(journal, "SELECT count(*) FROM row");
  const sqlite3_int64 cases = ask(journal, "SELECT value FROM about WHERE name = 'cases'");
  if (done <= 0 || done >= cases) return ZP_OK;
  return zp_fail(err, ZP_BAD_INPUT,
                 "%.300s: %lld of %lld cases of an unfinished campaign; give --resume to continue it, delete this file "
                 "to start again, or choose another folder",
                 journal->path, (long long)done, (long long)cases);
}

/* Discard the existing journal. */
static ZpStatus replace_old(ZpJournal *journal, const char *directory, ZpError *err) {
  ZpStatus status = refuse_unfinished(journal, err);
  sqlite3_close(journal->base);
  journal->base = NULL;
  return status == ZP_OK ? remove_old(directory, err) : status;
}

/* Only an empty file gets our tables. */
static ZpStatus need_tables(ZpJournal *journal, ZpError *err) {
  const sqlite3_int64 tables = ask(journal, "SELECT count(*) FROM sqlite_master");
  if (tables == 0) return make_tables(journal, err);
  if (tables > 0 && is_ours(journal)) return ZP_OK;
  return zp_fail(err, ZP_BAD_INPUT, "%.300s: not a journal of this version of zipact; start without --resume",
                 journal->path);
}

static ZpStatus read_names(ZpJournal *journal, ZpError *err) {
  sqlite3_stmt *query = NULL;
  int step = SQLITE_ROW;
  bool added = true;
  if (sqlite3_prepare_v2(journal->base, "SELECT name, unit, help, timing FROM name ORDER BY id", -1, &query, NULL))
    return fail_base(journal, err);
  while (added && (step = sqlite3_step(query)) == SQLITE_ROW) {
    const ZpName name = {(char *)sqlite3_column_text(query, 0), (char *)sqlite3_column_text(query, 1),
                         (char *)sqlite3_column_text(query, 2), sqlite3_column_int(query, 3) != 0};
    added = name.name && name.unit && zp_names_add(&journal->names, &name);
  }
  ZpStatus status = !added ? zp_fail_memory(err) : step == SQLITE_DONE ? ZP_OK : fail_base(journal, err);
  journal->names_written = journal->names.count;
  sqlite3_finalize(query);
  return status;
}

static ZpStatus prepare(ZpJournal *journal, const char *sql, sqlite3_stmt **statement, ZpError *err) {
  const int answer = sqlite3_prepare_v3(journal->base, sql, -1, SQLITE_PREPARE_PERSISTENT, statement, NULL);
  return answer == SQLITE_OK ? ZP_OK : fail_base(journal, err);
}

static ZpStatus prepare_get(ZpJournal *journal, ZpError *err) {
  return prepare(journal, "SELECT number, outcome, message, result FROM row WHERE number >= ? ORDER BY number",
                 &journal->get, err);
}

static ZpStatus prepare_all(ZpJournal *journal, ZpError *err) {
  ZpStatus status = prepare_get(journal, err);
  if (status == ZP_OK)
    status = prepare(journal, "INSERT OR REPLACE INTO row VALUES(?, ?, ?, ?, ?)", &journal->put, err);
  return status == ZP_OK ? prepare(journal, "INSERT INTO name VALUES(?, ?, ?, ?, ?)", &journal->put_name, err) : status;
}

static ZpStatus open_base(ZpJournal *journal, size_t cases, ZpError *err) {
  char sql[160];
  snprintf(sql, sizeof sql, "DELETE FROM row WHERE number >= %zu; INSERT OR REPLACE INTO about VALUES('cases', '%zu')",
           cases, cases);
  if (sqlite3_open_v2(journal->path, &journal->base, open_flags | SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, NULL))
    return journal->base ? fail_base(journal, err) : zp_fail_memory(err);
  ZpStatus status = need_tables(journal, err);
  if (status == ZP_OK) status = run(journal, "PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL", err);
  if (status == ZP_OK) status = run(journal, sql, err);
  if (status == ZP_OK) status = read_names(journal, err);
  return status == ZP_OK ? prepare_all(journal, err) : status;
}

static ZpJournal *create(void) {
  ZpJournal *journal = calloc(1, sizeof *journal);
  if (journal && pthread_mutex_init(&journal->lock, NULL) == 0) return journal;
  free(journal);
  return NULL;
}

ZpStatus zp_journal_open(const char *directory, ZpStudy study, bool keep, size_t cases, ZpJournal **out, ZpError *err) {
  ZpJournal *journal = *out = create();
  ZpStatus status = journal && (journal->path = zp_path_join(directory, file_name)) ? ZP_OK : zp_fail_memory(err);
  if (status == ZP_OK) journal->row.study = study;
  if (status == ZP_OK && !keep) status = replace_old(journal, directory, err);
  if (status == ZP_OK) status = open_base(journal, cases, err);
  if (status == ZP_OK) return ZP_OK;
  zp_journal_close(journal);
  *out = NULL;
  return status;
}

/* (journal with its path and study) => true if it is open for reading */
static bool open_reader(ZpJournal *journal) {
  return sqlite3_open_v2(journal->path, &journal->base, open_flags | SQLITE_OPEN_READONLY, NULL) == SQLITE_OK &&
         read_names(journal, NULL) == ZP_OK && prepare_get(journal, NULL) == ZP_OK;
}

ZpJournal *zp_journal_reader(const ZpJournal *journal) {
  ZpJournal *reader = journal->open ? NULL : create();
  if (!reader) return NULL;
  reader->row.study = journal->row.study;
  reader->path = strdup(journal->path);
  if (reader->path && open_reader(reader)) return reader;
  zp_journal_close(reader);
  return NULL;
}

void zp_journal_close(ZpJournal *journal) {
  if (!journal) return;
  if (journal->open) zp_journal_commit(journal, NULL);
  sqlite3_finalize(journal->put);
  sqlite3_finalize(journal->get);
  sqlite3_finalize(journal->put_name);
  sqlite3_close(journal->base);
  zp_record_clear(&journal->row);
  zp_names_free(&journal->names);
  free(journal->record.byte);
  free(journal->path);
  pthread_mutex_destroy(&journal->lock);
  free(journal);
}

/* -- rows ------------------------------------------------------------------------------------------- */

/* The outcome with this word; ZP_BAD_ARGUMENT for any other word. */
static ZpOutcome outcome_of(const char *word) {
  for (int i = 0; word && strcmp(zp_outcome_name((ZpOutcome)i), "unknown") != 0; i++)
    if (strcmp(zp_outcome_name((ZpOutcome)i), word) == 0) return (ZpOutcome)i;
  return ZP_BAD_ARGUMENT;
}

ZpStatus zp_journal_visit(ZpJournal *journal, void (*visit)(void *user, size_t number, uint64_t hash, bool good),
                          void *user, ZpError *err) {
  sqlite3_stmt *query = NULL;
  int step;
  if (sqlite3_prepare_v2(journal->base, "SELECT number, hash, outcome FROM row ORDER BY number", -1, &query, NULL))
    return fail_base(journal, err);
  while ((step = sqlite3_step(query)) == SQLITE_ROW)
    visit(user, (size_t)sqlite3_column_int64(query, 0), (uint64_t)sqlite3_column_int64(query, 1),
          zp_outcome_good(outcome_of((const char *)sqlite3_column_text(query, 2))));
  sqlite3_finalize(query);
  return step == SQLITE_DONE ? ZP_OK : fail_base(journal, err);
}

/* Run a statement with bound values. */
static ZpStatus finish(ZpJournal *journal, sqlite3_stmt *statement, ZpError *err) {
  const bool done = sqlite3_step(statement) == SQLITE_DONE;
  ZpStatus status = done ? ZP_OK : fail_base(journal, err);
  sqlite3_reset(statement);
  return status;
}

static ZpStatus write_name(ZpJournal *journal, size_t number, ZpError *err) {
  const ZpName *name = &journal->names.item[number];
  sqlite3_bind_int64(journal->put_name, 1, (sqlite3_int64)number);
  sqlite3_bind_text(journal->put_name, 2, name->name, -1, SQLITE_STATIC);
  sqlite3_bind_text(journal->put_name, 3, name->unit, -1, SQLITE_STATIC);
  sqlite3_bind_text(journal->put_name, 4, name->help, -1, SQLITE_STATIC);
  sqlite3_bind_int(journal->put_name, 5, name->timing);
  return finish(journal, journal->put_name, err);
}

static ZpStatus write_names(ZpJournal *journal, ZpError *err) {
  ZpStatus status = ZP_OK;
  pthread_mutex_lock(&journal->lock);
  for (; journal->names_written < journal->names.count && status == ZP_OK; journal->names_written++)
    status = write_name(journal, journal->names_written, err);
  pthread_mutex_unlock(&journal->lock);
  return status;
}

static void end_reading(ZpJournal *journal) {
  sqlite3_reset(journal->get);
  journal->reading = false;
}

/* Requires the lock. */
static ZpPacked *pack(ZpJournal *journal, const ZpResult *result) {
  if (!zp_record_write(&journal->record, &journal->names, result)) return NULL;
  ZpPacked *row = malloc(sizeof *row + journal->record.used);
  if (!row) return NULL;
  row->outcome = result->outcome;
  memcpy(row->message, result->message, sizeof row->message);
  row->size = journal->record.used;
  memcpy(row->byte, journal->record.byte, row->size);
  return row;
}

ZpPacked *zp_journal_pack(ZpJournal *journal, const ZpResult *result) {
  pthread_mutex_lock(&journal->lock);
  ZpPacked *row = pack(journal, result);
  pthread_mutex_unlock(&journal->lock);
  return row;
}

ZpStatus zp_journal_put(ZpJournal *journal, size_t number, uint64_t hash, const ZpPacked *row, ZpError *err) {
  end_reading(journal);
  ZpStatus status = journal->open ? ZP_OK : run(journal, "BEGIN", err);
  journal->open = status == ZP_OK;
  if (status == ZP_OK) status = write_names(journal, err);
  if (status != ZP_OK) return status;
  sqlite3_bind_int64(journal->put, 1, (sqlite3_int64)number);
  sqlite3_bind_int64(journal->put, 2, (sqlite3_int64)hash);
  sqlite3_bind_text(journal->put, 3, zp_outcome_name(row->outcome), -1, SQLITE_STATIC);
  sqlite3_bind_text(journal->put, 4, row->message, -1, SQLITE_STATIC);
  sqlite3_bind_blob64(journal->put, 5, row->byte, row->size, SQLITE_STATIC);
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
      sqlite3_step(journal->get) == SQLITE_ROW && sqlite3_column_int64(journal->get, 0) == (sqlite3_int64)number;
  if (!journal->reading) end_reading(journal);
  return journal->reading;
}

/* False if there is no such row, or it is damaged. */
static bool read_row(ZpJournal *journal, size_t number) {
  sqlite3_stmt *query = journal->get;
  ZpResult *result = &journal->row;
  if (!find_row(journal, number)) return false;
  const char *message = (const char *)sqlite3_column_text(query, 2);
  const unsigned char *byte = sqlite3_column_blob(query, 3);
  result->outcome = outcome_of((const char *)sqlite3_column_text(query, 1));
  snprintf(result->message, sizeof result->message, "%s", message ? message : "");
  return byte && zp_record_read(byte, (size_t)sqlite3_column_bytes(query, 3), &journal->names, result);
}

const ZpResult *zp_journal_get(ZpJournal *journal, size_t number) {
  if (journal->has_row && journal->at == number) return &journal->row;
  journal->has_row = read_row(journal, number);
  if (!journal->has_row) zp_record_clear(&journal->row);
  journal->bad = journal->bad || !journal->has_row;
  return &journal->row;
}

ZpStatus zp_journal_status(ZpJournal *journal, ZpError *err) {
  if (!journal->bad) return ZP_OK;
  return zp_fail(err, ZP_MACHINE, "%.300s: a row cannot be read: no memory, or it is damaged", journal->path);
}
