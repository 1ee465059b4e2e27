#include "rest/chain.h"

#include <math.h>
#include <string.h>

#include "base/fail.h"

/* -- creation --------------------------------------------------------------------------------------- */

static ZpStatus open_member(ZpChain *chain, const ZpModel *member, ZpError *err) {
  size_t k = chain->count++;
  ZpActuatorDef def = zp_member_at_rest(member);
  ZpStatus status = zp_model_create(&def, &chain->alone[k], err);
  if (status != ZP_OK) return status;
  zp_model_take_laws(chain->alone[k], member);
  if (!zp_rest_open(&chain->of[k], chain->alone[k], NULL, NULL)) return zp_fail_memory(err);
  chain->at[k + 1] = chain->at[k] + chain->of[k].statics.assembly.n;
  return ZP_OK;
}

static void weigh_member(ZpChain *chain, size_t k, const ZpModel *member) {
  const ZpAssembly *assembly = &chain->of[k].statics.assembly;
  double *mass = chain->mass + chain->at[k], *vertical = chain->vertical + chain->at[k];
  zp_assembly_masses(assembly, member->mass, mass);
  for (size_t j = 0; j < member->count; j++) {
    int row = assembly->equation[2 * j + 1];
    if (row >= 0) vertical[row] = mass[row];
    chain->total[k] += member->mass[j];
  }
}

/* The height of a member's lower platform. */
static size_t load_of(const ZpChain *chain, size_t k) {
  return chain->at[k] + zp_statics_platform(&chain->of[k].statics);
}

/* Eq. (29.3): each member moves relative to its upper platform, and with that platform. */
static void weigh(const void *self, const double *u, double *mu) {
  const ZpChain *chain = self;
  double momentum[ZP_MOST_MEMBERS] = {0}, way = 0, below = 0;
  for (size_t k = 0; k < chain->count; k++) {
    momentum[k] = chain->total[k] * way;
    for (size_t i = chain->at[k]; i < chain->at[k + 1]; i++) {
      momentum[k] += chain->vertical[i] * u[i];
      mu[i] = chain->mass[i] * u[i] + chain->vertical[i] * way;
    }
    way += u[load_of(chain, k)];
  }
  for (size_t k = chain->count; k-- > 0;) {
    mu[load_of(chain, k)] += below;
    below += momentum[k];
  }
}

/* The stiffness of a member does not depend on the positions of the others. */
static void solve(const void *self, double *f) {
  const ZpChain *chain = self;
  for (size_t k = 0; k < chain->count; k++)
    zp_band_solve(&chain->of[k].branch.newton.K, f + chain->at[k]);
}

ZpStatus zp_chain_open(ZpChain *chain, const ZpModel *uppermost, ZpError *err) {
  *chain = (ZpChain){.vibrating = {weigh, solve, chain}};
  for (const ZpModel *m = uppermost; m; m = m->below) {
    ZpStatus status = open_member(chain, m, err);
    if (status != ZP_OK) return status;
  }
  size_t n = chain->at[chain->count];
  chain->memory = chain->mass = zp_calloc(2 * n, sizeof *chain->mass);
  if (!chain->memory) return zp_fail_memory(err);
  chain->vertical = chain->mass + n;
  size_t k = 0;
  for (const ZpModel *m = uppermost; m; m = m->below)
    weigh_member(chain, k++, m);
  return ZP_OK;
}

void zp_chain_close(ZpChain *chain) {
  zp_free(chain->memory);
  for (size_t k = 0; k < chain->count; k++) {
    zp_rest_close(&chain->of[k]);
    zp_model_destroy(chain->alone[k]);
  }
}

void zp_chain_watch(ZpChain *chain, bool (*stop)(void *caller), void *caller) {
  for (size_t k = 0; k < chain->count; k++) {
    chain->of[k].statics.stop = stop;
    chain->of[k].statics.caller = caller;
  }
}

bool zp_chain_stopped(const ZpChain *chain) {
  bool stopped = false;
  for (size_t k = 0; k < chain->count; k++)
    stopped |= chain->of[k].statics.stopped;
  return stopped;
}

/* -- states ----------------------------------------------------------------------------------------- */

bool zp_chain_hang(ZpChain *chain) {
  for (size_t k = 0; k < chain->count; k++) {
    ZpRest *rest = &chain->of[k];
    if (!zp_newton_good(zp_statics_hang(&rest->statics, &rest->branch.newton).end)) return false;
    if (!zp_statics_stable(&rest->statics, &rest->branch.newton)) return false;
  }
  return true;
}

bool zp_chain_raise(ZpChain *chain, double voltage) {
  for (size_t k = 0; k < chain->count; k++) {
    ZpRest *rest = &chain->of[k];
    if (!zp_statics_raise(&rest->statics, voltage, &rest->branch.newton)) return false;
    if (!zp_statics_stable(&rest->statics, &rest->branch.newton)) return false;
  }
  return true;
}

/* Has Newton's method found the state next to the one from which it started, on the same branch? */
static bool has_stayed(ZpRest *rest, double voltage, double opening) {
  static const double part = 0.02; /* of the length; a small change moves less */
  ZpStatics *s = &rest->statics;
  if (!zp_newton_good(zp_rest_settle(rest, voltage).end)) return false;
  return fabs(zp_statics_opening(s) - opening) < part * s->model->L && zp_statics_stable(s, &rest->branch.newton);
}

static bool change_one(ZpRest *rest, double voltage) {
  ZpStatics *s = &rest->statics;
  rest->system.save(s, rest->branch.saved);
  if (has_stayed(rest, voltage, zp_statics_opening(s))) return true;
  rest->system.restore(s, rest->branch.saved);
  return zp_newton_good(zp_statics_fall(s, voltage, &rest->branch.newton).end) && !zp_statics_fault(s);
}

bool zp_chain_change(ZpChain *chain, double voltage) {
  for (size_t k = 0; k < chain->count; k++)
    if (!change_one(&chain->of[k], voltage)) return false;
  return true;
}
