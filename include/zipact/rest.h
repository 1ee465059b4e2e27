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
 * the left), m; distance of the platforms' faces, m, NAN of one ribbon. */
ZP_API double zp_rest_stroke(const ZpRest *rest);
ZP_API double zp_rest_opening(const ZpRest *rest);

#ifdef __cplusplus
}
#endif

#endif
