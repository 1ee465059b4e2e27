/* Rules: combinations of keys that are refused. A rule is a row of a table in the file that owns the reason, a law, a
 * device, a source or a study. This file has one form, one checker and one message for all of them.
 * docs/rules.md lists the rows. */
#ifndef ZP_DEF_RULE_H
#define ZP_DEF_RULE_H

#include "def/check.h"

/* Why a combination is refused. */
typedef enum ZpRuleClass {
  ZP_RULE_PHYSICS,     /* it has no meaning: no actuator has it, or its keys contradict each other */
  ZP_RULE_EQUATION,    /* an equation is missing, which `why` names */
  ZP_RULE_NOT_MODELLED /* its equations are known, and the program does not have them */
} ZpRuleClass;

/* Properties of a device, bits of ZpDevice.has (def/device.h). */
enum {
  ZP_DEVICE_ELECTRODES = 1, /* that attract each other */
  ZP_DEVICE_PAIR = 2,       /* two ribbons */
  ZP_DEVICE_PLATFORM = 4,   /* two ribbons with a platform in the middle of each, and a mirror image */
  ZP_DEVICE_OPEN = 8,       /* two ribbons whose right ends are free */
  ZP_DEVICE_HINGE = 16,     /* a hinge at the left end of the lower ribbon */
  ZP_DEVICE_COUNTER = 32,   /* a rigid counter electrode */
  ZP_DEVICE_POUCH = 128,    /* two films that mirror each other around a fixed volume of liquid; one is modelled */
  ZP_DEVICE_SHAPED = 256,   /* a counter electrode whose shape counter.* says */
  ZP_DEVICE_RIGID = 512, /* two plates in place of ribbons: a platform as long as they are, on the springs of plate.* */
  ZP_DEVICE_PAPERS = 64, /* the ends that the paper's steps, zipping and surface know */
  ZP_DEVICE_ENDS = ZP_DEVICE_PAIR | ZP_DEVICE_POUCH /* an end that hangs on electrodes, and may be held */
};

typedef enum ZpTest {
  ZP_TEST_ANY,        /* holds always */
  ZP_TEST_IS,         /* the key has this value */
  ZP_TEST_IS_NOT,     /* it has another one */
  ZP_TEST_ONE_OF,     /* its word is in a set of bits */
  ZP_TEST_ABOVE,      /* above this value; not if it is auto or none */
  ZP_TEST_AT_LEAST,   /* at least this value */
  ZP_TEST_AT_MOST,    /* at most this value, or auto or none */
  ZP_TEST_SET,        /* differs from its default; of a member's key: one gives it */
  ZP_TEST_UNSET,      /* has its default */
  ZP_TEST_SET_WITHIN, /* any key from this one to another differs from its default */
  ZP_TEST_SEVERAL,    /* several members: zp_def_members; or a network */
  ZP_TEST_NETWORK,    /* bodies are given */
  ZP_TEST_PLANE,      /* and one moves in the plane */
  ZP_TEST_HAS,        /* the device of this actuator.kind has any of a set of ZP_DEVICE_ bits */
  ZP_TEST_LACKS,      /* it has none of them */
  ZP_TEST_FOLLOWS,    /* it has electrodes, or voltage drives a curvature: zp_def_drives */
  ZP_TEST_DRIVES,     /* voltage drives a curvature */
  ZP_TEST_NEVER       /* never holds */
} ZpTest;

/* A condition on the value of a key, SI. Of liquid.model, auto stands for what it means. */
typedef struct ZpCondition {
  int key;
  ZpTest test;
  double value; /* or the bits of a set of words, or the last key of a range */
} ZpCondition;

#define ZP_KEY(name) ((int)offsetof(ZpKeyNumbers, name))
#define ZP_CONDITION(name, is, value)                                                                                  \
  { ZP_KEY(name), ZP_TEST_##is, value }
#define ZP_ANY                    ZP_CONDITION(actuator.kind, ANY, 0)
#define ZP_NEVER                  ZP_CONDITION(actuator.kind, NEVER, 0)
#define ZP_IS(name, value)        ZP_CONDITION(name, IS, value)
#define ZP_NOT(name, value)       ZP_CONDITION(name, IS_NOT, value)
#define ZP_ONE_OF(name, bits)     ZP_CONDITION(name, ONE_OF, bits)
#define ZP_ABOVE(name, value)     ZP_CONDITION(name, ABOVE, value)
#define ZP_AT_LEAST(name, value)  ZP_CONDITION(name, AT_LEAST, value)
#define ZP_AT_MOST(name, value)   ZP_CONDITION(name, AT_MOST, value)
#define ZP_SET(name)              ZP_CONDITION(name, SET, 0)
#define ZP_UNSET(name)            ZP_CONDITION(name, UNSET, 0)
#define ZP_SET_WITHIN(name, last) ZP_CONDITION(name, SET_WITHIN, ZP_KEY(last))
#define ZP_HAS(device)            ZP_CONDITION(actuator.kind, HAS, ZP_DEVICE_##device)
#define ZP_LACKS(device)          ZP_CONDITION(actuator.kind, LACKS, ZP_DEVICE_##device)
#define ZP_USES_VOLTAGE           ZP_CONDITION(actuator.kind, FOLLOWS, 0)
#define ZP_CURVES_BY_VOLTAGE      ZP_CONDITION(segment_K.curvature_per_volt, DRIVES, 0)
#define ZP_SEVERAL                ZP_CONDITION(stack.series, SEVERAL, 0)
#define ZP_NETWORK                ZP_CONDITION(body_K.mass, NETWORK, 0)
#define ZP_PLANE                  ZP_CONDITION(body_K.moves, PLANE, 0)
#define ZP_BIT(word)              (1 << (word))

/* If `when` and `also` hold, `needs` must hold. */
typedef struct ZpRule {
  ZpRuleClass class;
  bool in_motion; /* for runs in time only */
  ZpCondition when, also, needs;
  const char *why;
} ZpRule;

/* A rule for every study; for runs in time; both with two conditions. */
#define ZP_RULE(class, when, needs, why)                                                                               \
  { ZP_RULE_##class, false, when, ZP_ANY, needs, why }
#define ZP_RULE_IF(class, when, also, needs, why)                                                                      \
  { ZP_RULE_##class, false, when, also, needs, why }
#define ZP_MOTION_RULE(class, when, needs, why)                                                                        \
  { ZP_RULE_##class, true, when, ZP_ANY, needs, why }
#define ZP_MOTION_RULE_IF(class, when, also, needs, why)                                                               \
  { ZP_RULE_##class, true, when, also, needs, why }

/* Rules of a law that holds for two equal insulators; for two equal ribbons. */
#define ZP_RULES_EQUAL_INSULATORS(class, when, why)                                                                    \
  {ZP_RULE_##class, false, when, ZP_ANY, ZP_UNSET(lower.insulator.thickness), why}, {                                  \
    ZP_RULE_##class, false, when, ZP_ANY, ZP_UNSET(lower.insulator.permittivity), why                                  \
  }
#define ZP_RULES_EQUAL_RIBBONS(class, when, why)                                                                       \
  {ZP_RULE_##class, false, when, ZP_ANY, ZP_UNSET(lower.insulator.thickness), why},                                    \
      {ZP_RULE_##class, false, when, ZP_ANY, ZP_UNSET(lower.insulator.permittivity), why}, {                           \
    ZP_RULE_##class, false, when, ZP_ANY, ZP_UNSET(lower.ribbon.thickness), why                                        \
  }

/* The rules of an owner. */
typedef struct ZpRules {
  const ZpRule *rule;
  size_t count;
} ZpRules;

#define ZP_RULES_OF(array)                                                                                             \
  { array, sizeof(array) / sizeof(array)[0] }

/* The owners of rules.def: arrays that end with NULL. */
#define ZP_OWNER(name) extern const ZpRules *const zp_rules_of_##name[];
#include "def/rules.def"
#undef ZP_OWNER

/* The first of these rules that refuses `def`, of those in motion or of the others; NULL: none. */
const ZpRule *zp_rules_find(const ZpRules *rules, bool in_motion, const ZpActuatorDef *def);

/* The first rule of all owners that refuses `def`, of those in motion or of the others; NULL: none. */
const ZpRule *zp_rule_refusing(bool in_motion, const ZpActuatorDef *def);

/* The first key from one to another that has not its default and would be refused with it; -1: none. */
int zp_key_without_use(const ZpActuatorDef *def, int first, int last);

/* The rule for which this value of a choice key would be refused, whatever the key is now; NULL: none. */
const ZpRule *zp_rule_against(int key, int choice, const ZpActuatorDef *def);

/* Fail with the message of a rule that refuses `def`: "load.stiffness = 5 N/m: requires actuator.kind electro_ribbon,
 * but it is flange; why". `asks` stands before "requires": "", "motion " or "study modes ". ZP_OK if `rule` is NULL. */
ZpStatus zp_rule_fail(const ZpRule *rule, const char *asks, const ZpActuatorDef *def, ZpError *err);

/* A condition in words: "liquid.model bead", "electro.edges false". */
void zp_condition_text(const ZpCondition *condition, char *text, size_t size);

#endif
