/* Layout, counts of 8 bytes, all little-endian: number of names; of each name, unit, help, each with its 0, and a byte
 * for timing; of each result outcome (a byte), message with its 0, size of its record, record. */
#include "campaign/remote.h"

#include <stdlib.h>
#include <string.h>

#include <zipact/campaign.h>

#include "base/fail.h"
#include "fit/case.h"

/* -- writing ---------------------------------------------------------------------------------------- */

static void put_count(FILE *out, size_t count) {
  for (int i = 0; i < 8; i++)
    fputc((int)((uint64_t)count >> 8 * i & 0xff), out);
}

static void put_text(FILE *out, const char *text) {
  fwrite(text, 1, strlen(text) + 1, out);
}

static void put_names(FILE *out, const ZpNames *names) {
  put_count(out, names->count);
  for (size_t i = 0; i < names->count; i++) {
    put_text(out, names->item[i].name);
    put_text(out, names->item[i].unit);
    put_text(out, names->item[i].help ? names->item[i].help : "");
    fputc(names->item[i].timing ? 1 : 0, out);
  }
}

/* Append a result to the message, and its names to `names`. False if there is no memory. */
static bool put_result(FILE *out, ZpRecord *record, ZpNames *names, const ZpResult *result) {
  if (!zp_record_write(record, names, result)) return false;
  fputc((int)result->outcome, out);
  put_text(out, result->message);
  put_count(out, record->used);
  return fwrite(record->byte, 1, record->used, out) == record->used;
}

/* Run the cases one after the other and append their results. */
static ZpStatus compute_all(const ZpScenario *scenario, size_t from, size_t to, const ZpHooks *hooks, FILE *out,
                            ZpNames *names, ZpError *err) {
  ZpRecord record = {0};
  ZpResult *before = NULL;
  ZpStatus status = ZP_OK;
  const bool keeps_series = zp_scenario_keeps_series(scenario);
  for (size_t i = from; i < to && status == ZP_OK; i++) {
    ZpResult *result = NULL;
    status = zp_case_run_or_say(scenario, i, before, hooks, &result, err);
    zp_result_destroy(before);
    before = result;
    if (status != ZP_OK) break;
    if (!keeps_series) {
      zp_table_destroy(result->series);
      result->series = NULL;
    }
    if (!put_result(out, &record, names, result)) status = zp_fail_memory(err);
  }
  zp_result_destroy(before);
  free(record.byte);
  return status;
}

/* The names precede the results in the message, but are only known after them. */
static ZpStatus join(const ZpNames *names, const char *results, size_t length, unsigned char **byte, size_t *size,
                     ZpError *err) {
  char *all = NULL;
  FILE *out = open_memstream(&all, size);
  if (!out) return zp_fail_memory(err);
  put_names(out, names);
  fwrite(results, 1, length, out);
  const bool written = ferror(out) == 0;
  *byte = fclose(out) == 0 ? (unsigned char *)all : NULL;
  return *byte && written ? ZP_OK : zp_fail_memory(err);
}

ZpStatus zp_campaign_compute(const ZpScenario *scenario, size_t from, size_t to, const ZpHooks *hooks,
                             unsigned char **byte, size_t *size, ZpError *err) {
  ZpNames names = {0};
  char *results = NULL;
  size_t length;
  *byte = NULL;
  FILE *out = open_memstream(&results, &length);
  if (!out) return zp_fail_memory(err);
  ZpStatus status = compute_all(scenario, from, to, hooks, out, &names, err);
  const bool written = ferror(out) == 0;
  if ((fclose(out) != 0 || !written) && status == ZP_OK) status = zp_fail_memory(err);
  if (status == ZP_OK) status = join(&names, results, length, byte, size, err);
  free(results);
  zp_names_free(&names);
  return status;
}

/* -- reading ---------------------------------------------------------------------------------------- */

typedef struct Reader {
  const unsigned char *byte;
  size_t left;
  bool bad;
} Reader;

static const unsigned char *take(Reader *reader, size_t size) {
  reader->bad = reader->bad || size > reader->left;
  if (reader->bad) return NULL;
  reader->byte += size;
  reader->left -= size;
  return reader->byte - size;
}

static size_t get_count(Reader *reader) {
  const unsigned char *byte = take(reader, 8);
  uint64_t count = 0;
  for (int i = 0; byte && i < 8; i++)
    count |= (uint64_t)byte[i] << 8 * i;
  return (size_t)count;
}

static const char *get_text(Reader *reader) {
  const size_t length = strnlen((const char *)reader->byte, reader->left);
  return (const char *)take(reader, length + 1);
}

/* Their numbers are those of the message; their texts are those of the names that are kept. */
static void get_names(Reader *reader, ZpRemote *remote, ZpNames *names) {
  const size_t count = get_count(reader);
  reader->bad = reader->bad || count > reader->left;
  names->item = reader->bad ? NULL : calloc(count + 1, sizeof *names->item);
  reader->bad = reader->bad || !names->item;
  for (; !reader->bad && names->count < count; names->count++) {
    const char *name = get_text(reader), *unit = get_text(reader), *help = get_text(reader);
    const unsigned char *timing = take(reader, 1);
    if (reader->bad) return;
    const ZpName one = {(char *)name, (char *)unit, *help ? (char *)help : NULL, *timing != 0};
    const size_t number = zp_names_number(&remote->names, &one);
    reader->bad = number == remote->names.count;
    if (!reader->bad) names->item[names->count] = remote->names.item[number];
  }
}

/* The next result, new; NULL if it cannot be read. */
static ZpResult *get_result(Reader *reader, const ZpNames *names, ZpStudy study) {
  const unsigned char *outcome = take(reader, 1);
  const char *message = get_text(reader);
  const size_t size = get_count(reader);
  const unsigned char *record = take(reader, size);
  ZpResult *result = record ? zp_result_create(study) : NULL;
  ZpResult row = {.study = study};
  if (result && zp_record_read(record, size, names, &row)) {
    *result = row;
    result->outcome = (ZpOutcome)*outcome;
    snprintf(result->message, sizeof result->message, "%s", message);
    return result;
  }
  zp_record_clear(&row);
  zp_result_destroy(result);
  return NULL;
}

bool zp_remote_read(ZpRemote *remote, const unsigned char *byte, size_t size, ZpStudy study, size_t count,
                    ZpResult **result) {
  Reader reader = {byte, size, false};
  ZpNames names = {0};
  size_t read = 0;
  get_names(&reader, remote, &names);
  while (read < count && !reader.bad && (result[read] = get_result(&reader, &names, study)))
    read++;
  free(names.item);
  if (read == count && reader.left == 0) return true;
  while (read > 0)
    zp_result_destroy(result[--read]);
  return false;
}

void zp_remote_free(ZpRemote *remote) {
  zp_names_free(&remote->names);
  *remote = (ZpRemote){0};
}
