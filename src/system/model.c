/* A model with its laws: terms, rows of the ledger, places of their state. */
#include "system/system.h"

static const ZpTerm *const table[] = {
#define ZP_TERM(name) &zp_term_##name,
#include "term/terms.def"
#undef ZP_TERM
};
_Static_assert(sizeof table / sizeof table[0] < ZP_MOST_TERMS, "a model has room for all terms, and one of a program");

const ZpRow zp_row_kinetic_energy = ZP_STORED(kinetic_energy, "kinetic energy");

/* The number of a row, which laws may share. */
static size_t number_of(ZpLedger *ledger, const ZpRow *row) {
  size_t k = 0;
  while (k < ledger->rows && ledger->row[k] != row)
    k++;
  if (k == ledger->rows) ledger->row[ledger->rows++] = row;
  return k;
}

bool zp_model_add_term(ZpModel *model, const ZpTerm *term) {
  if (model->laws == ZP_MOST_TERMS || model->ledger.rows + ZP_ROWS_OF_TERM > ZP_MOST_ROWS) return false;
  ZpLaw *law = &model->law[model->laws++];
  *law = (ZpLaw){.term = term, .at = model->kept, .state = term->state ? term->state(model) : 0};
  model->kept += law->state;
  while (law->rows < ZP_ROWS_OF_TERM && term->row[law->rows]) {
    law->row[law->rows] = number_of(&model->ledger, term->row[law->rows]);
    law->rows++;
  }
  return true;
}

static bool add_laws(ZpModel *model) {
  bool all = true;
  number_of(&model->ledger, &zp_row_kinetic_energy);
  for (size_t k = 0; k < sizeof table / sizeof table[0]; k++)
    if (!table[k]->acts || table[k]->acts(model)) all = all && zp_model_add_term(model, table[k]);
  for (const ZpRow *const *row = zp_supply_rows; model->supply.acts && *row; row++)
    number_of(&model->ledger, *row);
  return all;
}

ZpStatus zp_model_create_driven(const ZpActuatorDef *def, const ZpDriveTable *table_of_drive, ZpModel **out,
                                ZpError *err) {
  ZpStatus status = zp_model_build(def, table_of_drive, out, err);
  for (ZpModel *model = *out; model; model = model->below)
    add_laws(model);
  return status;
}

ZpStatus zp_model_create(const ZpActuatorDef *def, ZpModel **out, ZpError *err) {
  return zp_model_create_driven(def, NULL, out, err);
}
