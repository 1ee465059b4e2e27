/* What an FMU begins with: the keys of the scenario that it was written for. A block of data that stands in the binary
 * of every FMU; `zipact fmu` fills it in where it finds its mark. So a binary reads no file, and needs no compiler to
 * be made. */
#ifndef ZP_FMU_START_H
#define ZP_FMU_START_H

#include <stdint.h>

#include <zipact/def.h>

/* Number of keys, of each type by one. */
#define ZP_GROUP(group)
#define ZP_GROUP_END(group)
#define ZP_REAL(path, name, unit, shown, def, min, max, help)           +1
#define ZP_REAL_AS(path, field, name, unit, shown, def, min, max, help) +1
#define ZP_REAL_AUTO(path, name, unit, shown, min, max, help)           +1
#define ZP_REAL_NONE(path, name, unit, shown, min, max, help)           +1
#define ZP_INT(path, name, def, min, max, help)                         +1
#define ZP_BOOL(path, name, def, help)                                  +1
#define ZP_ENUM(path, name, type, def, help)                            +1
#define ZP_TEXT(path, name, def, help)                                  +1
#define ZP_OF_SCENARIO(name, type, def, help)                           +1
enum {
  ZP_FMU_KEYS = 0
#include <zipact/keys.def>
};

/* 16 bytes that stand nowhere else in a binary, without a final 0; as text for a source. */
#define ZP_FMU_MARK "\x93zipact-fmu-v1\r\n"

/* Bytes of the token with the final 0. */
enum { ZP_FMU_MARK_SIZE = 16, ZP_FMU_TOKEN_SIZE = 40 };

typedef struct ZpFmuStart {
  char mark[ZP_FMU_MARK_SIZE];
  uint64_t size;                 /* of this block, bytes: that of a binary of another version may be smaller */
  uint64_t layout;               /* zp_def_layout of the program that the binary was made with */
  char token[ZP_FMU_TOKEN_SIZE]; /* GUID of FMI 2, instantiation token of FMI 3 */
  double value[ZP_FMU_KEYS];     /* of each key, as zp_def_get; 0 of keys that have none */
} ZpFmuStart;

/* That of this FMU. */
extern const volatile ZpFmuStart zp_fmu_start;

/* (start) => the Def that it stands for. ZP_BAD_INPUT if it was never filled in, or by a program with other keys. */
ZpStatus zp_fmu_start_def(const ZpFmuStart *start, ZpActuatorDef *def, ZpError *err);

/* The voltage that the input has until it is set: that of a step; of other waveforms, which an FMU has not, 0. V */
double zp_fmu_first_voltage(const ZpActuatorDef *def);

/* The setpoint that the input has until it is set: setpoint.value, or where that is none, 0. */
double zp_fmu_first_setpoint(const ZpActuatorDef *def);

/* Does key `index` have a number? All but texts and keys of the scenario. */
bool zp_fmu_has_number(int index);

#endif
