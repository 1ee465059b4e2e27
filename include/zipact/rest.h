/* A model at rest, for programs that ask for one state after another. Whole studies of rest: study.h. */
#ifndef ZIPACT_REST_H
#define ZIPACT_REST_H

#include <stdbool.h>

#include <zipact/api.h>
#include <zipact/model.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct ZpRest ZpRest;

/* `model` at rest, which must outlive it; straight at first. *rest is NULL where there is no memory (ZP_MACHINE). */
ZP_API ZpStatus zp_rest_create(const ZpModel *model, ZpRest **rest, ZpError *err);

/* Free it; NULL is allowed. */
ZP_API void zp_rest_destroy(ZpRest *rest);

/* Move to the equilibrium in which the actuator hangs at `voltage` (V, 0 or more), the one that a slowly rising voltage
 * leads to. False if there is none: the actuator pulls in below it, electrodes without an insulator touch, or no
 * equilibrium was found. */
ZP_API bool zp_rest_hang(ZpRest *rest, double voltage);

/* The present state: height of the clip over the lower platform, signed (of one ribbon: how far its right end is below
 * the left), m; distance between the platforms' faces, m, NAN of one ribbon. */
ZP_API double zp_rest_stroke(const ZpRest *rest);
ZP_API double zp_rest_opening(const ZpRest *rest);

/* Its capacitance between the electrodes, F, of the whole actuator. */
ZP_API double zp_rest_capacitance(const ZpRest *rest);

/* Derivatives of both by key `key` at the present state, which zp_rest_hang has found: m per SI unit of the key, the
 * voltage being that of the state; exact but for rounding. Where the state has none they are NAN. ZP_BAD_INPUT: `key`
 * is no real number that the model has (zp_study_check says what sensitivity.by may name), or electro.model is
 * field; ZP_MACHINE: no memory. */
ZP_API ZpStatus zp_rest_sensitivity(ZpRest *rest, int key, double *stroke, double *opening, ZpError *err);

#ifdef __cplusplus
}
#endif

#endif
