/* A supply: what it makes of the voltage that it is told (the command), and how much current it gives. First a lag,
 * then a slew rate lead to the inner voltage V; a series resistance and limits of the current follow. Knows nothing of
 * what it drives. docs/theory.md, section 23. */
#ifndef ZP_DRIVE_SUPPLY_H
#define ZP_DRIVE_SUPPLY_H

#include "base/row.h"
#include "def/rule.h"
#include "drive/waveform.h"

/* Its rows of the ledger, then NULL. */
extern const ZpRow *const zp_supply_rows[];

typedef struct ZpSupply {
  bool acts;                        /* else the electrodes have the voltage of the command, whatever current flows */
  double rate;                      /* of the lag, 1/s; INFINITY: none; NAN: that of its list */
  double dead;                      /* time from off to the first voltage, s; NAN: that of its list */
  const struct ZpSupplyLevel *list; /* [levels] of source.supply, from the lowest level on; NULL: it has none */
  size_t levels;
  double slew;        /* V/s; INFINITY: none */
  double most, sinks; /* largest current out and in, A; INFINITY: none */
  double resistance;  /* in series, ohm */
  double capacitance; /* parallel to the electrodes, F */
  double conductance; /* of the bleeder at 0 V, S */
  double doubles;     /* voltage at which it has doubled, V; INFINITY: nowhere */
} ZpSupply;

ZpSupply zp_supply_of(const ZpActuatorDef *def);

/* Rate of the lag of a supply whose command goes to this voltage, 1/s; INFINITY: none. */
double zp_supply_lag_rate(const ZpSupply *supply, double level);

/* Its time from off to the first voltage, s. */
double zp_supply_dead_time(const ZpSupply *supply, double level);

/* Current through its bleeder at voltage U, A, eq. (23.10), and its derivative, S. */
double zp_supply_bled(const ZpSupply *supply, double U);
double zp_supply_bled_slope(const ZpSupply *supply, double U);

/* Command to a supply: the waveform, or what a program has set by hand. */
typedef struct ZpCommand {
  const ZpWaveform *waveform;
  const ZpRamp *by_hand; /* NULL: the waveform */
} ZpCommand;

/* The command from time t on, V; at a jump behind it. */
double zp_command_voltage(const ZpCommand *command, double t);

/* Evolving part of a supply. */
typedef struct ZpSupplyState {
  double lagged;  /* the command behind the lag, V */
  double voltage; /* inner voltage, V */
  double ready; /* share of the dead time that has passed since the command left 0: 1 once it runs, 0 while it is off */
} ZpSupplyState;

/* Of a supply that has run at this voltage for long. */
static inline ZpSupplyState zp_supply_at(double voltage) {
  return (ZpSupplyState){voltage, voltage, voltage != 0};
}

/* At time t: a command of 0 that stays turns a running supply off; a jump of the command passes what neither lags nor
 * has a slew rate. */
ZpSupplyState zp_supply_jump(const ZpSupply *supply, const ZpCommand *command, double t, ZpSupplyState at);

/* From time `from`, its jumps passed, to `to`: between them is neither a corner of the command nor an event. */
ZpSupplyState zp_supply_follow(const ZpSupply *supply, const ZpCommand *command, double from, double to,
                               ZpSupplyState at);

/* The first time after t, at `latest` or before, at which the dead time has passed, or the slew rate begins or ceases
 * to limit; INFINITY if there is none within a second. */
double zp_supply_event(const ZpSupply *supply, const ZpCommand *command, double t, double latest, ZpSupplyState at);

/* Rate of the inner voltage just after t, V/s. */
double zp_supply_rate(const ZpSupply *supply, const ZpCommand *command, double t, ZpSupplyState at);

/* Combinations of its keys that are refused. */
extern const ZpRules zp_rules_supply;

#endif
