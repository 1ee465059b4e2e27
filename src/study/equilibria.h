/* The common part of all studies of equilibria: a model at rest, the table and shapes of its points, what materials
 * have seen in them, and the numbers that a system of several members has in addition. */
#ifndef ZP_STUDY_EQUILIBRIA_H
#define ZP_STUDY_EQUILIBRIA_H

#include "rest/rest.h"
#include "study/notes.h"
#include "study/studies.h"

/* Columns of most tables, and their values at the present point. */
#define ZP_ELECTRIC_COLUMNS                                                                                            \
  {"zipped_length_m", "m", "closed length of one half, from the clip"}, {"charge_C", "C", "charge on the electrodes"}, \
  {                                                                                                                    \
    "capacitance_F", "F", "capacitance of the electrodes"                                                              \
  }
#define ZP_STATE_COLUMNS                                                                                               \
  {"stroke_m", "m", "height of the clip over the lower platform, signed"},                                             \
      {"opening_m", "m", "distance between the platforms' faces"}, ZP_ELECTRIC_COLUMNS
#define ZP_ELECTRIC_VALUES(s) zp_statics_closed_length(s), zp_statics_charge(s), zp_statics_capacitance(s)
#define ZP_STATE_VALUES(s)    zp_statics_stroke(s), zp_statics_opening(s), ZP_ELECTRIC_VALUES(s)

/* A study at work. The first lines are set before it is opened. */
typedef struct ZpEquilibria {
  const ZpTask *task;
  ZpResult *result;
  const char *stage;      /* what it is doing, for the caller */
  double top;             /* the voltage at which that is done, V; 0: it is not known */
  const ZpColumn *column; /* the study's columns; NULL: its table is another */
  size_t columns;
  size_t rows, shapes; /* most of them that the result keeps */
  bool held;           /* the platform will be held */
  ZpModel *model;
  ZpRest rest;
  ZpMargins margins; /* what materials have seen */
  double *row;       /* of the table: the study's columns, and */
  double *behind;    /* margins and what several members have */
} ZpEquilibria;

/* Create the model of `def`, table and shapes, with the caller's arrays as of zp_rest_open. To be closed in any case.
 */
ZpStatus zp_equilibria_open(ZpEquilibria *at, const ZpActuatorDef *def, void (*reserve)(void *user, ZpArena *arena),
                            void *user, ZpError *err);
void zp_equilibria_close(ZpEquilibria *at);

/* Add the present point as a row, of which the study has these columns, and as a shape with this number. `last`: both
 * are kept as the last ones. The stiffness of the state is then factored. */
void zp_equilibria_add(ZpEquilibria *at, const double *columns, double number, bool last);

/* Count what materials see at the present point. */
void zp_equilibria_look(ZpEquilibria *at);

/* Margins of what was seen and of the clip at `voltage`, the highest (V), and notes on what rest leaves out. */
void zp_equilibria_note(ZpEquilibria *at, double voltage);

/* Add what several members have in addition as numbers of the result. */
void zp_equilibria_add_members(ZpEquilibria *at);

#endif
