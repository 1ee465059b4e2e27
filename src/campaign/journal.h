/* journal.sqlite: one row per case that is done. */
#ifndef ZP_CAMPAIGN_JOURNAL_H
#define ZP_CAMPAIGN_JOURNAL_H

#include <stdint.h>

#include <zipact/io.h>

typedef struct ZpJournal ZpJournal;

/* Open or make the journal of a `study` in `directory`. `keep`: that which is there is kept, but rows of numbers from
 * `cases` on; ZP_BAD_INPUT if it is no journal of ours. Else it is replaced; ZP_BAD_INPUT if it lacks
 * rows that its campaign has not computed yet. ZP_MACHINE if it cannot be written. *out is NULL on failure. */
ZpStatus zp_journal_open(const char *directory, ZpStudy study, bool keep, size_t cases, ZpJournal **out, ZpError *err);

/* Another reader of the rows that are on the disk, for a thread of its own; nothing can be put through it. NULL if
 * there are rows that are not there yet, or it cannot be opened. */
ZpJournal *zp_journal_reader(const ZpJournal *journal);

/* Commit, and close; NULL is allowed. */
void zp_journal_close(ZpJournal *journal);

/* Tell `visit` of every row that is there. */
ZpStatus zp_journal_visit(ZpJournal *journal, void (*visit)(void *user, size_t number, uint64_t hash, bool good),
                          void *user, ZpError *err);

/* A result as the journal has it: some hundred bytes. */
typedef struct ZpPacked {
  ZpOutcome outcome;
  char message[sizeof(((ZpResult *)0)->message)];
  size_t size;
  unsigned char byte[]; /* record.h */
} ZpPacked;

/* Pack a result, in any thread, while another puts rows, but none reads them => to be freed. NULL if there is no
 * memory.
 */
ZpPacked *zp_journal_pack(ZpJournal *journal, const ZpResult *result);

/* Put a row, replacing one of the same number. It is on the disk after the next zp_journal_commit. */
ZpStatus zp_journal_put(ZpJournal *journal, size_t number, uint64_t hash, const ZpPacked *row, ZpError *err);

/* Bring what was put to the disk; nothing if nothing was. */
ZpStatus zp_journal_commit(ZpJournal *journal, ZpError *err);

/* Say that no more rows will come than there are: the journal may be replaced. */
ZpStatus zp_journal_finish(ZpJournal *journal, ZpError *err);

/* Row `number`, valid until the next call. Where it cannot be read it is empty, and from then on zp_journal_status says
 * so. */
const ZpResult *zp_journal_get(ZpJournal *journal, size_t number);
ZpStatus zp_journal_status(ZpJournal *journal, ZpError *err);

#endif
