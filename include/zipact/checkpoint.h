/* The state of a run in memory, from which the run can resume; io.h reads and writes it as a file.
 *
 * A resumed run takes exactly the same steps as an uninterrupted one, to the last bit. For this reason the checkpoint
 * of a run whose last step was shortened to end at the end time is the state before this step.
 */
#ifndef ZIPACT_CHECKPOINT_H
#define ZIPACT_CHECKPOINT_H

#include <zipact/api.h>
#include <zipact/sim.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A snapshot: the bytes of zp_sim_save and of a checkpoint.zps. */
typedef struct ZpCheckpoint {
  size_t size;
  unsigned char *byte; /* [size] */
} ZpCheckpoint;

/* A checkpoint from `size` bytes of a snapshot => *out, which belongs to the caller. ZP_BAD_INPUT, and NULL, if they
 * are not a snapshot, cut short, damaged, or of another version of the format. zp_checkpoint_check checks whether it
 * fits a model. */
ZP_API ZpStatus zp_checkpoint_from(const void *bytes, size_t size, ZpCheckpoint **out, ZpError *err);
ZP_API void zp_checkpoint_destroy(ZpCheckpoint *checkpoint);

/* Time at which a resumed run starts, s. */
ZP_API double zp_checkpoint_time(const ZpCheckpoint *checkpoint);

/* Must key `index` be the same in a resumed run? True for all keys that define the actuator. Keys that say what is done
 * with it may change: drive, end time, accuracy, output, keys of other studies. */
ZP_API bool zp_checkpoint_holds(int index);

/* Can a run of `def` resume from `checkpoint`? ZP_BAD_INPUT names the first key that differs, with both values, or
 * gives another reason: its numbers are not a state, or the end time is earlier than it. */
ZP_API ZpStatus zp_checkpoint_check(const ZpCheckpoint *checkpoint, const ZpActuatorDef *def, ZpError *err);

/* The last state through which a longer run of the simulation would also pass; after ZP_DIVERGED or ZP_BEYOND_MODEL,
 * the last valid one. *out is NULL if the simulation found no initial state. */
ZP_API ZpStatus zp_sim_checkpoint(const ZpSim *sim, ZpCheckpoint **out, ZpError *err);

/* Resume from `checkpoint`. If the waveform has another voltage at that time, the voltage jumps. ZP_BAD_INPUT as
 * zp_checkpoint_check; the simulation is then unchanged. */
ZP_API ZpStatus zp_sim_continue(ZpSim *sim, const ZpCheckpoint *checkpoint, ZpError *err);

#ifdef __cplusplus
}
#endif

#endif
