/* The state of a run, from which it can be resumed: in memory; as a file, see io.h.
 *
 * A resumed run takes exactly the same steps as an uninterrupted one, to the last bit. For this reason, the checkpoint
 * of a run that its end time has cut short is the state before that last, shortened step.
 */
#ifndef ZIPACT_CHECKPOINT_H
#define ZIPACT_CHECKPOINT_H

#include <zipact/api.h>
#include <zipact/sim.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A snapshot, as zp_sim_save writes it and checkpoint.zps holds it. */
typedef struct ZpCheckpoint {
  size_t size;
  unsigned char *byte; /* [size] */
} ZpCheckpoint;

/* A checkpoint of `size` bytes that were stored anywhere => *out, the caller's. ZP_BAD_INPUT, and NULL, if they are no
 * snapshot, cut short, damaged, or of another version of the format. Whether it fits a model, zp_checkpoint_check says.
 */
ZP_API ZpStatus zp_checkpoint_from(const void *bytes, size_t size, ZpCheckpoint **out, ZpError *err);
ZP_API void zp_checkpoint_destroy(ZpCheckpoint *checkpoint);

/* The time at which a run resumes from it, s. */
ZP_API double zp_checkpoint_time(const ZpCheckpoint *checkpoint);

/* Must key `index` be the same where a run resumes? True of all that makes the actuator; what is done with it (drive,
 * end time, accuracy, output, keys of other studies) may change. */
ZP_API bool zp_checkpoint_holds(int index);

/* Can a run of `def` resume from it? ZP_BAD_INPUT names the first key that differs, with both values, or says what
 * else is wrong: numbers that are no state, an end time before it. */
ZP_API ZpStatus zp_checkpoint_check(const ZpCheckpoint *checkpoint, const ZpActuatorDef *def, ZpError *err);

/* The last state of the simulation that a longer run passes through, too; after ZP_DIVERGED one shortly before that was
 * still sound. *out is NULL where it found no state to start from. */
ZP_API ZpStatus zp_sim_checkpoint(const ZpSim *sim, ZpCheckpoint **out, ZpError *err);

/* Resume from it. A waveform that asks for another voltage at that time makes it jump. ZP_BAD_INPUT as
 * zp_checkpoint_check; the simulation is then as it was. */
ZP_API ZpStatus zp_sim_continue(ZpSim *sim, const ZpCheckpoint *checkpoint, ZpError *err);

#ifdef __cplusplus
}
#endif

#endif
