// The public headers together in C++, and a program on them: linked with the C library, so that a missing
// extern "C" shows. Exits with 0 if all is right, else prints what is not.
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>

#include <zipact/def.h>
#include <zipact/error.h>
#include <zipact/io.h>
#include <zipact/model.h>
#include <zipact/sim.h>
#include <zipact/study.h>
#include <zipact/table.h>
#include <zipact/version.h>
#include <zipact/zipact.h>

static int failures = 0;

static void check(bool good, const std::string &what) {
  if (good) return;
  std::fprintf(stderr, "api_cpp: %s\n", what.c_str());
  failures++;
}

// The destroy functions serve as deleters.
using Def = std::unique_ptr<ZpActuatorDef, decltype(&zp_def_destroy)>;
using Info = std::unique_ptr<ZpRunInfo, decltype(&zp_run_info_destroy)>;
using Model = std::unique_ptr<ZpModel, decltype(&zp_model_destroy)>;
using Sim = std::unique_ptr<ZpSim, decltype(&zp_sim_destroy)>;
using Result = std::unique_ptr<ZpResult, decltype(&zp_result_destroy)>;
using Scenario = std::unique_ptr<ZpScenario, decltype(&zp_scenario_destroy)>;

static Def short_def() {
  Def owner(zp_def_create(), zp_def_destroy);
  ZpActuatorDef *def = owner.get();
  zp_def_set_number(def, "actuator.kind", ZP_KIND_ELECTRO_RIBBON, nullptr);
  zp_def_set_number(def, "mesh.nodes", 5, nullptr);
  zp_def_set_number(def, "solver.tolerance", 1e-1, nullptr);
  zp_def_set_number(def, "solver.end_time", 1e-4, nullptr);
  return owner;
}

static void run_a_simulation() {
  const Def def = short_def();
  ZpError err{};
  ZpModel *model = nullptr;
  ZpSim *sim = nullptr;
  check(zp_model_create(def.get(), &model, &err) == ZP_OK, err.message);
  Model model_owner(model, zp_model_destroy);
  check(zp_model_get(model, "ribbons") == 2, "a model of two ribbons");
  check(zp_sim_create(model, nullptr, &sim, &err) == ZP_OK, err.message);
  Sim sim_owner(sim, zp_sim_destroy);
  const Info info(zp_run_info_create(), zp_run_info_destroy);
  check(zp_sim_run(sim, 1e-4, false, nullptr, info.get()) == ZP_REACHED_END, zp_run_info_message(info.get()));
  check(zp_sim_get(sim, "stroke") > 0, "a stroke");
}

static void run_a_study() {
  const Def def = short_def();
  ZpError err{};
  int calls = 0;
  ZpHooks hooks{};
  hooks.user = &calls;
  hooks.progress = [](void *user, const char *, double) { return ++*static_cast<int *>(user) < 0; };
  ZpResult *result = nullptr;
  check(zp_study_run(ZP_STUDY_ACTUATE, def.get(), nullptr, &hooks, &result, &err) == ZP_OK, err.message);
  Result owner(result, zp_result_destroy);
  check(result && zp_result_series(result) && zp_table_rows(zp_result_series(result)) > 1, "a table");
  check(std::isfinite(zp_result_get(result, "stroke_m")), "a stroke of the study");
  check(calls > 0, "progress");
}

static void read_a_scenario() {
  Scenario scenario(zp_scenario_create(), zp_scenario_destroy);
  ZpError err{};
  const std::string text = "load: {mass: [8 g, 20 g]}\n";
  check(zp_scenario_parse(scenario.get(), text.data(), text.size(), "text", &err) == ZP_OK, err.message);
  check(zp_scenario_count(scenario.get()) == 2, "two Defs");
  check(zp_scenario_set(scenario.get(), "load.mas=1", &err) == ZP_BAD_INPUT, "a wrong key is refused");
  check(std::strstr(err.message, "load.mass") != nullptr, "and the right one named");
}

int main() {
  run_a_simulation();
  run_a_study();
  read_a_scenario();
  check(std::strlen(ZP_VERSION) > 0, "a version");
  check(zp_key(zp_key_find("load.mass"))->def == 8e-3, "a key");
  return failures == 0 ? 0 : 1;
}
