/* journal.sqlite: one row per finished case. */
#ifndef ZP_CAMPAIGN_JOURNAL_H
#define ZP_CAMPAIGN_JOURNAL_H

#include <stdint.h>

#include "io/packed.h"

typedef struct ZpJournal ZpJournal;

/* Open or create the journal of a `study` in `directory`. With `keep` the rows of an existing journal stay, except
 * those with numbers from `cases` on; ZP_BAD_INPUT if the file is not a journal, or names the version of which it is.
 * Otherwise it is replaced; ZP_BAD_INPUT if its campaign is unfinished. ZP_MACHINE if it cannot be written. *out is
 * NULL on failure. */
ZpStatus zp_journal_open(const char *directory, ZpStudy study, bool keep, size_t cases, ZpJournal **out, ZpError *err);

/* Commit and close; NULL is allowed. */
void zp_journal_close(ZpJournal *journal);

/* Call `visit` for every row. */
ZpStatus zp_journal_visit(ZpJournal *journal, void (*visit)(void *user, size_t number, uint64_t hash, bool good),
                          void *user, ZpError *err);

/* Put a row, replacing one of the same number. It is on the disk after the next zp_journal_commit. */
ZpStatus zp_journal_put(ZpJournal *journal, size_t number, uint64_t hash, const ZpPacked *row, ZpError *err);

/* Bring all put rows to the disk; does nothing if there are none. */
ZpStatus zp_journal_commit(ZpJournal *journal, ZpError *err);

/* Mark the campaign as finished: the journal may be replaced. */
ZpStatus zp_journal_finish(ZpJournal *journal, ZpError *err);

/* Row `number`, valid until the next call; its names stay until the journal is closed. If it cannot be read the result
 * is empty, and zp_journal_status reports the error from then on. */
const ZpResult *zp_journal_get(ZpJournal *journal, size_t number);
ZpStatus zp_journal_status(ZpJournal *journal, ZpError *err);

/* The rows for a report. `open` gives readers of those on the disk, for a thread of their own, unless some are not on
 * the disk yet or the file cannot be opened. */
ZpRows zp_journal_rows(ZpJournal *journal);

#endif
