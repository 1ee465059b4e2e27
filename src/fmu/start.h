/* The start values of an FMU: the keys of the scenario from which it was written. They are a block of data in the
 * binary of every FMU; `zipact fmu` finds the block by its mark and writes the values. So a binary reads no file, and
 * its writer needs no compiler. */
#ifndef ZP_FMU_START_H
#define ZP_FMU_START_H

#include <stdint.h>

#include "def/check.h"
#include <zipact/drive.h>

/* 16 bytes that occur nowhere else in a binary, without a final 0; as text for a source. */
#define ZP_FMU_MARK "\x93zipact-fmu-v1\r\n"

/* Bytes of the token including the final 0. */
enum { ZP_FMU_MARK_SIZE = 16, ZP_FMU_TOKEN_SIZE = 40 };

typedef struct ZpFmuStart {
  char mark[ZP_FMU_MARK_SIZE];
  uint64_t size;                 /* size of this block, bytes: that of a binary of another version may differ */
  uint64_t layout;               /* zp_fmu_keys_mark of the program with which the binary was built */
  char token[ZP_FMU_TOKEN_SIZE]; /* GUID of FMI 2, instantiation token of FMI 3 */
  double value[ZP_KEYS];         /* of each key, as zp_def_get; 0 for keys without a number */
} ZpFmuStart;

/* A number made of the names, types and words of all keys: two programs with the same number mean the same by a list of
 * values of all keys. */
uint64_t zp_fmu_keys_mark(void);

/* The block of this FMU. */
extern const volatile ZpFmuStart zp_fmu_start;

/* (start) => its Def. ZP_BAD_INPUT if it has no values, or those of a program with other keys. */
ZpStatus zp_fmu_start_def(const ZpFmuStart *start, ZpActuatorDef *def, ZpError *err);

/* Replace the waveforms of voltage and setpoint, of which `table` has the rows, by their values at t = 0, where the
 * inputs of an FMU begin. An FMU does not play a waveform. */
void zp_fmu_forget_waveforms(ZpActuatorDef *def, const ZpDriveTable *table);

/* The initial voltage of the input, V. */
double zp_fmu_first_voltage(const ZpActuatorDef *def);

/* The initial setpoint of the input: setpoint.value, or 0 if it is none. */
double zp_fmu_first_setpoint(const ZpActuatorDef *def);

/* Does key `index` have a number? All keys do except texts and keys of the scenario. */
bool zp_fmu_has_number(int index);

#endif
