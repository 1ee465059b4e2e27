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
  bool acts;          /* else the electrodes have the voltage of the command, whatever current flows */
  double rate;        /* of the lag, 1/s; INFINITY: none */
  double slew;        /* V/s; INFINITY: none */
  double most, sinks; /* largest current out and in, A; INFINITY: none */
  double resistance;  /* in series, ohm */
  double capacitance; /* parallel to the electrodes, F */
  double conductance; /* of the bleeder, S */
} ZpSupply;

ZpSupply zp_supply_of(const ZpActuatorDef *def);

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
} ZpSupplyState;

/* At time t: a jump of the command passes what neither lags nor has a slew rate. */
ZpSupplyState zp_supply_jump(const ZpSupply *supply, const ZpCommand *command, double t, ZpSupplyState at);

/* From time `from`, its jumps passed, to `to`: between them is neither a corner of the command nor an event. */
ZpSupplyState zp_supply_follow(const ZpSupply *supply, const ZpCommand *command, double from, double to,
                               ZpSupplyState at);

/* The first time after t, before `latest` (finite), at which the slew rate begins or ceases to limit; INFINITY if there
 * is none. */
double zp_supply_event(const ZpSupply *supply, const ZpCommand *command, double t, double latest, ZpSupplyState at);

/* Rate of the inner voltage just after t, V/s. */
double zp_supply_rate(const ZpSupply *supply, const ZpCommand *command, double t, ZpSupplyState at);

/* Combinations of its keys that are refused. */
extern const ZpRules zp_rules_supply;

#endif
