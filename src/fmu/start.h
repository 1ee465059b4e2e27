/* The start values of an FMU: the keys of the scenario from which it was written. They are a block of data in the
 * binary of every FMU; `zipact fmu` finds the block by its mark and writes the values. So a binary reads no file, and
 * its writer needs no compiler. */
#ifndef ZP_FMU_START_H
#define ZP_FMU_START_H

#include <stdint.h>

#include "def/check.h"
#include <zipact/drive.h>
#include <zipact/sim.h>

/* 16 bytes that occur nowhere else in a binary, without a final 0; as text for a source. */
#define ZP_FMU_MARK "\x93zipact-fmu-v1\r\n"

/* Bytes of the token including the final 0; largest number of given keys of members, bodies, springs and joints of a
 * network, and of names. */
enum { ZP_FMU_MARK_SIZE = 16, ZP_FMU_TOKEN_SIZE = 40, ZP_FMU_GIVEN = 2048, ZP_FMU_NAMES = 512 };

typedef struct ZpFmuStart {
  char mark[ZP_FMU_MARK_SIZE];
  uint64_t size;                 /* size of this block, bytes: that of a binary of another version may differ */
  uint64_t layout;               /* zp_fmu_keys_mark of the program with which the binary was built */
  char token[ZP_FMU_TOKEN_SIZE]; /* GUID of FMI 2, instantiation token of FMI 3 */
  double value[ZP_KEYS];         /* of each key, as zp_def_get; 0 for keys without a number */
  uint64_t givens, names;        /* of a network: how many keys of members, bodies and so on are given, and names */
  ZpAssignment given[ZP_FMU_GIVEN];
  ZpGivenName name[ZP_FMU_NAMES];
} ZpFmuStart;

/* A number made of the names, types and words of all keys: two programs with the same number mean the same by a list of
 * values of all keys. */
uint64_t zp_fmu_keys_mark(void);

/* The block of this FMU. */
extern const volatile ZpFmuStart zp_fmu_start;

/* (start) => its Def, which is cleared by zp_def_clear. ZP_BAD_INPUT if it has no values, or those of a program with
 * other keys. */
ZpStatus zp_fmu_start_def(const ZpFmuStart *start, ZpActuatorDef *def, ZpError *err);

/* Replace the waveforms of voltage and setpoint, of which `table` has the rows, by their values at t = 0, where the
 * inputs of an FMU begin. An FMU does not play a waveform. */
void zp_fmu_forget_waveforms(ZpActuatorDef *def, const ZpDriveTable *table);

/* The initial value of an input (zp_def_input_next) of a Def without waveforms: a voltage, V; a setpoint, or 0 if it is
 * none; 0 of a load. */
double zp_fmu_first(const ZpActuatorDef *def, int input);

/* Does key `index` have a number? All keys do except texts and keys of the scenario. */
bool zp_fmu_has_number(int index);

#endif
