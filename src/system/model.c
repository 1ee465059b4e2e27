/* A model with its laws: terms, rows of the ledger, places of their state. */
#include "system/system.h"

static const ZpTerm *const table[] = {
#define ZP_TERM(name) &zp_term_##name,
#include "term/terms.def"
#undef ZP_TERM
};
/* A program may add a law of its own. */
_Static_assert(sizeof table / sizeof table[0] < ZP_MOST_TERMS,
               "terms.def has more laws than a model has room for: raise ZP_MOST_TERMS in src/actuator/model.h");

#define ZP_SIGNAL(name, unit, suffix, help)
#define ZP_ROW(name) +1
enum {
  ROWS = 0
#include "base/signals.def"
#include "term/terms.def"
};
#undef ZP_SIGNAL
#undef ZP_ROW
_Static_assert(ROWS + ZP_ROWS_OF_TERM <= ZP_MOST_ROWS,
               "terms.def has more rows than a ledger has room for: raise ZP_MOST_ROWS in src/actuator/model.h");

const ZpRow zp_row_kinetic_energy = ZP_STORED(kinetic_energy, "kinetic energy");

/* The number of a row, which laws may share. */
static size_t number_of(ZpLedger *ledger, const ZpRow *row) {
  size_t k = zp_row_number(ledger, row);
  if (k == ledger->rows) ledger->row[ledger->rows++] = row;
  return k;
}

/* Those of a term => how many. */
static size_t number_rows(ZpLedger *ledger, const ZpTerm *term, size_t number[ZP_ROWS_OF_TERM]) {
  size_t rows = 0;
  for (; rows < ZP_ROWS_OF_TERM && term->row[rows]; rows++)
    number[rows] = number_of(ledger, term->row[rows]);
  return rows;
}

bool zp_model_add_term(ZpModel *model, const ZpTerm *term) {
  if (model->laws == ZP_MOST_TERMS || model->ledger.rows + ZP_ROWS_OF_TERM > ZP_MOST_ROWS) return false;
  const bool explicit = model->def.solver.integrator == ZP_INTEGRATOR_EXPLICIT; /* edges are damped in implicit steps */
  ZpLaw *law = &model->law[model->laws++];
  *law = (ZpLaw){.term = term, .at = model->kept, .state = term->state ? term->state(model) : 0};
  if (term->loss && !(term->of_edges && explicit)) model->losing[model->losers++] = (unsigned char)(law - model->law);
  law->rows = number_rows(&model->ledger, term, law->row);
  model->kept += law->state;
  return true;
}

static bool is_of_library(const ZpTerm *term) {
  for (size_t k = 0; k < sizeof table / sizeof table[0]; k++)
    if (table[k] == term) return true;
  return false;
}

void zp_model_take_laws(ZpModel *model, const ZpModel *from) {
  for (size_t m = 0; m < model->members; m++)
    for (const ZpLaw *law = from[m].law; law < from[m].law + from[m].laws; law++)
      if (!is_of_library(law->term)) zp_model_add_term(model + m, law->term);
}

/* The kinetic energy is the first row. */
static void add_laws(ZpModel *model) {
  ZpLedger *ledger = &model->ledger;
  size_t number[ZP_ROWS_OF_TERM];
  number_of(ledger, &zp_row_kinetic_energy);
  for (size_t k = 0; k < sizeof table / sizeof table[0]; k++)
    number_rows(ledger, table[k], number);
  for (const ZpRow *const *row = zp_supply_rows; *row; row++)
    number_of(ledger, *row);
  for (size_t k = 0; k < sizeof table / sizeof table[0]; k++)
    if (!table[k]->acts || table[k]->acts(model)) zp_model_add_term(model, table[k]);
}

static void add_laws_of_all(ZpModel *model) {
  for (size_t k = 0; k < model->members; k++)
    add_laws(model + k);
}

ZpStatus zp_model_create_driven(const ZpActuatorDef *def, const ZpDriveTable *table_of_drive, ZpModel **out,
                                ZpError *err) {
  ZpStatus status = zp_model_build(def, table_of_drive, out, err);
  if (status == ZP_OK) add_laws_of_all(*out);
  return status;
}

ZpStatus zp_model_create_on_mesh(const ZpModel *model, int nodes, ZpModel **out, ZpError *err) {
  ZpStatus status = zp_model_build_on_mesh(model, nodes, out, err);
  if (status != ZP_OK) return status;
  add_laws_of_all(*out);
  zp_model_take_laws(*out, model);
  return ZP_OK;
}

ZpStatus zp_model_create(const ZpActuatorDef *def, ZpModel **out, ZpError *err) {
  return zp_model_create_driven(def, NULL, out, err);
}
