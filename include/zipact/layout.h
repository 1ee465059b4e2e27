/* The layout of ZpActuatorDef as a number, by which a library detects a Def that was made with other headers. Part of
 * def.h, which includes this file. */
#include <zipact/def.h>
#ifndef ZIPACT_LAYOUT_H
#define ZIPACT_LAYOUT_H

#include <stddef.h>
#include <stdint.h>

#include <zipact/version.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The layout of ZpActuatorDef in these headers as a number. It changes if a key or a word is added or removed, and if a
 * key gets another type, place or name (only length and last letters count). It is a sum over all keys, which an
 * optimising compiler evaluates. Library and program have the same number if they were compiled with the same keys.def
 * and choices.def. */
static inline uint64_t zp_def_layout(void) {
#define ZP_LETTER(name, back) ((uint64_t)(unsigned char)(name)[sizeof(name) - 1 - (back)])
#define ZP_NAME_TERM(name)                                                                                             \
  (sizeof(name) + 37 * ZP_LETTER(name, 1) + 41 * ZP_LETTER(name, 2) + 43 * ZP_LETTER(name, 3) + 47 * ZP_LETTER(name, 4))
#define ZP_KEY_TERM(field, name, type)                                                                                 \
  +((uint64_t)offsetof(ZpActuatorDef, field) + 1) *                                                                    \
      (offsetof(ZpActuatorDef, field) + 31 * ZP_NAME_TERM(name) + UINT64_C(7) * (type))
#define ZP_GROUP(group)
#define ZP_GROUP_END(group)
#define ZP_REAL(path, name, unit, shown, def, min, max, help)           ZP_KEY_TERM(path name, #path #name, 1)
#define ZP_REAL_AS(path, field, name, unit, shown, def, min, max, help) ZP_KEY_TERM(path field, #path #name, 1)
#define ZP_REAL_AUTO(path, name, unit, shown, min, max, help)           ZP_KEY_TERM(path name, #path #name, 2)
#define ZP_REAL_NONE(path, name, unit, shown, min, max, help)           ZP_KEY_TERM(path name, #path #name, 2)
#define ZP_INT(path, name, def, min, max, help)                         ZP_KEY_TERM(path name, #path #name, 3)
#define ZP_BOOL(path, name, def, help)                                  ZP_KEY_TERM(path name, #path #name, 4)
#define ZP_ENUM(path, name, type, def, help)                            ZP_KEY_TERM(path name, #path #name, 5 + (uint64_t)type##_COUNT)
#define ZP_TEXT(path, name, def, help)                                  ZP_KEY_TERM(path name, #path #name, 4 + ZP_TEXT_SIZE)
#define ZP_OF_SCENARIO(name, type, def, help)                           +(uint64_t)type##_COUNT *ZP_NAME_TERM(#name)
  return (uint64_t)ZP_ABI << 48 ^ ((uint64_t)sizeof(ZpActuatorDef)
#include <zipact/keys.def>
                                  );
#undef ZP_LETTER
#undef ZP_NAME_TERM
#undef ZP_KEY_TERM
}

#ifdef __cplusplus
}
#endif

#endif
