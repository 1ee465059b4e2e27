/* A snapshot: the state of a simulation as bytes that may come back from anywhere. The one format of saved states,
 * files, pickles: what differs or is damaged is refused, for the kernels would follow it beyond their arrays. Inside
 * one simulation a plain copy of the ZpState is the same. */
#ifndef ZP_RUN_SNAPSHOT_H
#define ZP_RUN_SNAPSHOT_H

#include "actuator/model.h"

/* Bytes that zp_snapshot_write writes: as many for each state of the model, and of all below it. */
size_t zp_snapshot_size(const ZpModel *model);

/* (model, its states [members]) => bytes. Equal states give equal bytes, on every machine. */
void zp_snapshot_write(const ZpModel *model, ZpState *const state[], void *bytes);

/* (bytes) => states. ZP_BAD_INPUT as zp_snapshot_check, and if arrays differ; some states may then have changed. */
ZpStatus zp_snapshot_read(const ZpModel *model, const void *bytes, size_t size, ZpState *const state[], ZpError *err);

/* Are these bytes a whole snapshot, and one of a model with the keys of `def` (NULL: of any)? ZP_BAD_INPUT says what is
 * wrong: none at all, cut short, damaged, of another version of the format; or names the first key that differs, or
 * says that its numbers are no state. */
ZpStatus zp_snapshot_check(const ZpActuatorDef *def, const void *bytes, size_t size, ZpError *err);

/* The time of a snapshot that zp_snapshot_check has passed, s. */
double zp_snapshot_time(const void *bytes, size_t size);

/* States near one whose numbers change by a key at `rate`, a state of derivatives. At `offset` of the key: flags and
 * counts are those of `at`. */
void zp_state_along(const ZpModel *model, const ZpState *at, const ZpState *rate, double offset, ZpState *near);

/* rate += weight times what `near` has beyond `at`; 0 of what either has not, being NAN or INFINITY. */
void zp_state_add_rate(const ZpModel *model, const ZpState *at, const ZpState *near, double weight, ZpState *rate);

#endif
