/* Rows of the ledger: quantities that a law stores or loses, or only shows. A law defines its rows in its own file, and
 * laws that share a row name the same object. signals.def lists the rows in the order in which users see them;
 * those of terms.def follow. */
#ifndef ZP_BASE_ROW_H
#define ZP_BASE_ROW_H

typedef enum ZpRowKind {
  ZP_ROW_STORED, /* energy of one modelled part that it holds now, J */
  ZP_ROW_LOST,   /* energy of one modelled part that it has lost so far, J */
  ZP_ROW_GAVE,   /* energy that something beside electrodes and load has given to one modelled part so far, J */
  ZP_ROW_SOURCE, /* energy lost so far between the source and the electrodes of the whole actuator, J */
  ZP_ROW_SIGNAL  /* a value that belongs to no balance; of several members the largest counts */
} ZpRowKind;

/* Texts are part of the object, so that their addresses are constants. */
typedef struct ZpRow {
  char name[32];   /* of the signal, "jet_loss" */
  char column[40]; /* of the table, with its unit, "jet_loss_J" */
  char unit[8];    /* "J" */
  char help[160];  /* one line */
  ZpRowKind kind;
} ZpRow;

/* Values of rows; signals also say their unit and the suffix of their column. */
#define ZP_STORED(name, help)                                                                                          \
  { #name, #name "_J", "J", help, ZP_ROW_STORED }
#define ZP_LOST(name, help)                                                                                            \
  { #name, #name "_J", "J", help, ZP_ROW_LOST }
#define ZP_GAVE(name, help)                                                                                            \
  { #name, #name "_J", "J", help, ZP_ROW_GAVE }
#define ZP_LOST_BY_SOURCE(name, help)                                                                                  \
  { #name, #name "_J", "J", help, ZP_ROW_SOURCE }
#define ZP_SHOWN(name, unit, suffix, help)                                                                             \
  { #name, #name suffix, unit, help, ZP_ROW_SIGNAL }

#define ZP_ROW(name) extern const ZpRow zp_row_##name;
#define ZP_SIGNAL(name, unit, suffix, help)
#include "base/signals.def"
#undef ZP_SIGNAL
#undef ZP_ROW

#endif
