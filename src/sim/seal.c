/* A state as bytes that may come back from anywhere: magic, fingerprint of model and version, checksum, state.
 *
 * A state of another model, or a damaged one, would send the kernels beyond their arrays: fingerprint and checksum keep
 * it out. */
#include <string.h>

#include "base/fail.h"
#include "sim/sim_internal.h"

#include <zipact/version.h>

static const char magic[8] = "zipact1";
enum { FINGERPRINT = sizeof magic, SUM = FINGERPRINT + sizeof(uint64_t), HEAD = SUM + sizeof(uint64_t) };

/* FNV-1a, 64 bits. */
static uint64_t hash(uint64_t before, const void *data, size_t size) {
  const unsigned char *byte = data;
  for (size_t i = 0; i < size; i++)
    before = (before ^ byte[i]) * UINT64_C(0x100000001b3);
  return before;
}

static uint64_t fingerprint_of(const ZpModel *model) {
  uint64_t sum = hash(UINT64_C(0xcbf29ce484222325), ZP_VERSION, sizeof ZP_VERSION);
  for (int key = 0; key < zp_key_count(); key++) {
    if (zp_key(key)->offset == ZP_NO_FIELD) continue;
    const char *text = zp_def_text(&model->def, key);
    double value = zp_def_get(&model->def, key);
    sum = text ? hash(sum, text, strlen(text) + 1) : hash(sum, &value, sizeof value);
  }
  const ZpDriveTable *drive = &model->waveform.table;
  size_t size = drive->rows * sizeof(double);
  return hash(hash(sum, drive->time, size), drive->voltage, size);
}

size_t zp_sim_sealed_size(const ZpSim *sim) {
  return HEAD + zp_sim_state_size(sim);
}

void zp_sim_seal(const ZpSim *sim, void *sealed) {
  char *byte = sealed;
  zp_sim_save(sim, byte + HEAD);
  uint64_t fingerprint = fingerprint_of(sim->model);
  uint64_t sum = hash(fingerprint, byte + HEAD, zp_sim_state_size(sim));
  memcpy(byte, magic, sizeof magic);
  memcpy(byte + FINGERPRINT, &fingerprint, sizeof fingerprint);
  memcpy(byte + SUM, &sum, sizeof sum);
}

ZpStatus zp_sim_unseal(ZpSim *sim, const void *sealed, size_t size, ZpError *err) {
  const char *byte = sealed;
  uint64_t fingerprint, sum;
  if (size < HEAD || memcmp(byte, magic, sizeof magic) != 0)
    return zp_fail(err, ZP_BAD_INPUT, "state: not from a zipact simulation");
  memcpy(&fingerprint, byte + FINGERPRINT, sizeof fingerprint);
  memcpy(&sum, byte + SUM, sizeof sum);
  if (fingerprint != fingerprint_of(sim->model))
    return zp_fail(err, ZP_BAD_INPUT, "state: of another actuator, or of another version of zipact");
  if (sum != hash(fingerprint, byte + HEAD, size - HEAD)) return zp_fail(err, ZP_BAD_INPUT, "state: damaged");
  return zp_sim_restore(sim, byte + HEAD, size - HEAD, err);
}
