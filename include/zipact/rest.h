/* A model at rest, for programs that need one equilibrium after another. study.h has complete studies of equilibria. */
#ifndef ZIPACT_REST_H
#define ZIPACT_REST_H

#include <stdbool.h>

#include <zipact/api.h>
#include <zipact/model.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct ZpRest ZpRest;

/* `model` at rest, with straight ribbons at first. `model` must outlive it. *rest is NULL if there is no memory
 * (ZP_MACHINE). */
ZP_API ZpStatus zp_rest_create(const ZpModel *model, ZpRest **rest, ZpError *err);

/* Free it; NULL is allowed. */
ZP_API void zp_rest_destroy(ZpRest *rest);

/* Go to the equilibrium in which the actuator hangs at `voltage` (V; below 0 where its sign matters), to which a
 * voltage that slowly departs from 0 leads. False if there is none: the actuator pulls in at a lower voltage,
 * electrodes without an insulator touch, or no equilibrium was found. */
ZP_API bool zp_rest_hang(ZpRest *rest, double voltage);

/* The present state: height of the clip over the lower platform, signed (one ribbon: height of its left end over its
 * right end), m; distance between the platforms' faces, m, NAN for one ribbon. */
ZP_API double zp_rest_stroke(const ZpRest *rest);
ZP_API double zp_rest_opening(const ZpRest *rest);

/* The capacitance of the whole actuator, F. */
ZP_API double zp_rest_capacitance(const ZpRest *rest);

/* Derivatives of stroke and opening by key `key` in the present state, which zp_rest_hang has found, at its voltage: m
 * per SI unit of the key, exact except for rounding. They are NAN if they do not exist. ZP_BAD_INPUT: `key` is not a
 * real number of the model (as zp_study_check for sensitivity.by), or electro.model is field; ZP_MACHINE: no memory. */
ZP_API ZpStatus zp_rest_sensitivity(ZpRest *rest, int key, double *stroke, double *opening, ZpError *err);

#ifdef __cplusplus
}
#endif

#endif
