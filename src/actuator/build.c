/* Def => Model: numbers nodes, finds stiffnesses and masses, clamps the ends. */
#include <math.h>
#include <string.h>

#include "actuator/plane.h"
#include "base/fail.h"
#include "base/kernel.h"
#include "def/device.h"
#include "math/elementary.h"
#include "ribbon/rod_plastic.h"

enum { METAL, TAPE, LAYERS };

static void layers_of(const ZpActuatorDef *def, double thickness, ZpLayer layer[LAYERS]) {
  layer[METAL] = (ZpLayer){thickness, def->ribbon.young_modulus, def->ribbon.poisson_ratio, def->ribbon.density};
  double tape = isnan(def->insulator.thickness) ? 0 : def->insulator.thickness; /* a film that is its own insulator */
  layer[TAPE] = (ZpLayer){tape, def->insulator.young_modulus, 0, def->insulator.density};
}

static ZpSection section_of(const ZpActuatorDef *def, double thickness) {
  ZpLayer layer[LAYERS];
  layers_of(def, thickness, layer);
  return zp_section(layer, LAYERS, def->ribbon.width, def->ribbon.plane != ZP_PLANE_STRESS);
}

bool zp_ribbon_by_key(const ZpModel *model, size_t ribbon, int key, ZpSection *rate) {
  static const struct {
    int key, layer;
    ZpLayerNumber by;
  } of[] = {{ZP_KEY(ribbon.thickness), METAL, ZP_LAYER_THICKNESS},
            {ZP_KEY(ribbon.young_modulus), METAL, ZP_LAYER_MODULUS},
            {ZP_KEY(ribbon.density), METAL, ZP_LAYER_DENSITY},
            {ZP_KEY(insulator.thickness), TAPE, ZP_LAYER_THICKNESS},
            {ZP_KEY(insulator.young_modulus), TAPE, ZP_LAYER_MODULUS},
            {ZP_KEY(insulator.density), TAPE, ZP_LAYER_DENSITY}};
  ZpActuatorDef room;
  const ZpActuatorDef *def = ribbon > 0 ? zp_def_lower(&model->def, &room) : &model->def;
  const ZpSection section = zp_ribbon_section(model, ribbon);
  const double w = def->ribbon.width;
  ZpLayer layer[LAYERS];
  key = zp_def_key_of_ribbon(&model->def, ribbon > 0, key);
  *rate = (ZpSection){0};
  if (key < 0) return true;
  if (key == ZP_KEY(ribbon.width))
    *rate = (ZpSection){.EA = section.EA / w, .EI = section.EI / w, .mu = section.mu / w};
  if (key == ZP_KEY(ribbon.width)) return true;
  layers_of(def, def->ribbon.thickness, layer);
  for (size_t k = 0; model->ribbon[ribbon].places == 1 && k < sizeof of / sizeof of[0]; k++)
    if (key == of[k].key) {
      *rate = zp_section_by(layer, LAYERS, w, def->ribbon.plane != ZP_PLANE_STRESS, of[k].layer, of[k].by);
      return true;
    }
  return false;
}

/* Fibres of the metal, for a ribbon of one thickness. */
static ZpPlastic plastic_of(const ZpActuatorDef *def) {
  bool plane_strain = def->ribbon.plane != ZP_PLANE_STRESS;
  ZpLayer metal = {def->ribbon.thickness, def->ribbon.young_modulus, def->ribbon.poisson_ratio, def->ribbon.density};
  ZpSection section = section_of(def, def->ribbon.thickness);
  return zp_plastic(&metal, &section, def->ribbon.width, plane_strain, def->ribbon.yield_stress,
                    def->ribbon.hardening_modulus);
}

/* Branches of the layers that creep, for a ribbon of one thickness, eq. (39.8). */
static void find_branches(const ZpActuatorDef *def, ZpMaxwell branch[ZP_BRANCHES]) {
  const double modulus[LAYERS] = {def->ribbon.relaxation_modulus, def->insulator.relaxation_modulus},
               time[LAYERS] = {def->ribbon.relaxation_time, def->insulator.relaxation_time};
  const int plane_strain = def->ribbon.plane != ZP_PLANE_STRESS;
  ZpLayer layer[LAYERS];
  double below = -section_of(def, def->ribbon.thickness).axis;
  layers_of(def, def->ribbon.thickness, layer);
  for (int k = 0; k < LAYERS; k++) {
    layer[k].young_modulus = modulus[k];
    branch[k] = zp_maxwell(&layer[k], below, def->ribbon.width, plane_strain, modulus[k] > 0 ? time[k] : 0);
    below += layer[k].thickness;
  }
}

/* Eqs. (2.5) and (2.6), for a ribbon without segments. */
static ZpCurl curl_of(const ZpActuatorDef *def) {
  ZpActuatorDef narrow = *def;
  narrow.ribbon.plane = ZP_PLANE_STRESS;
  ZpSection wide = section_of(def, def->ribbon.thickness);
  double width2 = def->ribbon.width * def->ribbon.width;
  double missing = wide.EI - section_of(&narrow, def->ribbon.thickness).EI;
  if (def->ribbon.plane != ZP_PLANE_ANTICLASTIC) return (ZpCurl){0, 0};
  return (ZpCurl){missing, width2 * width2 * wide.EA / (4 * wide.EI)};
}

/* The sections along a ribbon from its left end on. The lower ribbon is a mirror image: `up` = -1 reverses its natural
 * curvatures. */
static ZpRibbon ribbon_of(const ZpActuatorDef *def, double up) {
  ZpRibbon ribbon = {.yields = def->ribbon.yield_stress, .curl = curl_of(def)};
  double along = 0;
  for (int k = 0; k < zp_def_segments(def); k++) {
    if (def->segment_K[k].length == 0) continue;
    along += def->segment_K[k].length;
    ribbon.place[ribbon.places++] = (ZpPlace){.section = section_of(def, def->segment_K[k].thickness),
                                              .curvature = up * def->segment_K[k].curvature,
                                              .per_volt = up * def->segment_K[k].curvature_per_volt,
                                              .per_volt_squared = up * def->segment_K[k].curvature_per_volt_squared,
                                              .lag = def->segment_K[k].curvature_lag,
                                              .end = along};
  }
  ribbon.place[ribbon.places++] = (ZpPlace){.section = section_of(def, def->ribbon.thickness), .end = INFINITY};
  return ribbon;
}

static bool is_driven(const ZpPlace *place) {
  return place->per_volt != 0 || place->per_volt_squared != 0;
}

/* A piece of an edge: from `from` to `to`, in edge lengths. */
typedef struct Piece {
  const ZpPlace *place;
  double from, to;
} Piece;

/* A place along the ribbon in edge lengths; within rounding of a node it is that node. */
static double in_edges(const ZpModel *model, double along) {
  static const double missed = 1e-9;
  double edges = along / model->l, node = round(edges);
  return fabs(edges - node) < missed ? node : edges;
}

/* The pieces of edge `station` of the left half between the ends of segments. => how many */
static int pieces_of(const ZpModel *model, size_t ribbon, size_t station, Piece piece[ZP_MOST_PLACES]) {
  const ZpPlace *place = model->ribbon[ribbon].place;
  double from = 0;
  int count = 0;
  for (size_t k = 0; k < model->ribbon[ribbon].places && from < 1; k++) {
    double to = fmin(in_edges(model, place[k].end) - (double)station, 1);
    if (to <= from) continue;
    piece[count++] = (Piece){&place[k], from, to};
    from = to;
  }
  return count;
}

/* The shares of an edge for its two nodes: integrals along it, weighted by 1 at the node and 0 at the other one. So a
 * step of the section counts at its place within the edge. */
typedef struct Share {
  double compliance; /* of bending, 1 / (N m) */
  double turn;       /* natural, rad; of one driven place per its curvature, m */
  double mass;       /* kg */
} Share;

/* The natural curvature of a place without voltage; while shares of one driven place are asked for, 1 there. */
static double curvature_of(const ZpPlace *place, const ZpPlace *driven) {
  return driven ? place == driven : place->curvature;
}

static Share share_of(const ZpModel *model, size_t ribbon, size_t station, bool right, const ZpPlace *driven) {
  Piece piece[ZP_MOST_PLACES];
  Share share = {0, 0, 0};
  int count = pieces_of(model, ribbon, station, piece);
  for (int k = 0; k < count; k++) {
    double middle = 0.5 * (piece[k].from + piece[k].to);
    double part = (piece[k].to - piece[k].from) * (right ? middle : 1 - middle) * model->l;
    share.compliance += part / piece[k].place->section.EI;
    share.turn += part * curvature_of(piece[k].place, driven);
    share.mass += part * piece[k].place->section.mu;
  }
  return share;
}

/* The sum of the shares of the edges beside node j. A rigid edge has none; those of the right half are mirror
 * images. */
static Share node_share(const ZpModel *model, size_t j, const ZpPlace *driven) {
  const ZpTopology *t = &model->topology;
  size_t ribbon = j % t->ribbons, station = zp_topology_station_image(t, j / t->ribbons);
  Share left = {0, 0, 0}, right = {0, 0, 0};
  if (station > 0) left = share_of(model, ribbon, station - 1, true, driven);
  if (station < zp_half_elements(t)) right = share_of(model, ribbon, station, false, driven);
  return (Share){left.compliance + right.compliance, left.turn + right.turn, left.mass + right.mass};
}

/* Share of the edge beside a held slope for the joint there, and for that joint and the next one together, eq.
 * (8.9). */
typedef struct LevelShare {
  double compliance, turn;   /* of the joint at the held slope: 1 / (N m), rad */
  double across, both_turns; /* between both: 1 / (N m); what the next one has of natural turn beside its own, rad */
} LevelShare;

static LevelShare level_share(const ZpModel *model, size_t ribbon, ZpLevelEnd level, const ZpPlace *driven) {
  size_t station = zp_topology_element_image(&model->topology, level.element);
  bool right = level.right != (station != level.element); /* the right half is a mirror image */
  Piece piece[ZP_MOST_PLACES];
  LevelShare share = {0, 0, 0, 0};
  int count = pieces_of(model, ribbon, station, piece);
  for (int k = 0; k < count; k++) {
    double from = right ? 1 - piece[k].to : piece[k].from, to = right ? 1 - piece[k].from : piece[k].to;
    double near = 1 - from, far = 1 - to, own = (near * near * near - far * far * far) * (model->l / 3);
    double both = (to * to * (3 - 2 * to) - from * from * (3 - 2 * from)) * (model->l / 12);
    share.compliance += own / piece[k].place->section.EI;
    share.across += both / piece[k].place->section.EI;
    share.turn += (own + both) * curvature_of(piece[k].place, driven);
    share.both_turns += both * curvature_of(piece[k].place, driven);
  }
  return share;
}

/* Axial compliance of an edge of the left half, m/N. */
static double edge_compliance(const ZpModel *model, size_t ribbon, size_t station) {
  Piece piece[ZP_MOST_PLACES];
  double sum = 0;
  int count = pieces_of(model, ribbon, station, piece);
  for (int k = 0; k < count; k++)
    sum += (piece[k].to - piece[k].from) * model->l / piece[k].place->section.EA;
  return sum;
}

static ZpMassSpringParams spring_of(const ZpModel *model) {
  const ZpActuatorDef *def = &model->def;
  ZpSection section = zp_ribbon_section(model, 0);
  double elements = (double)zp_half_elements(&model->topology), K_S = def->mass_spring.shear_coefficient;
  double text = section.EA * elements / model->L, code = section.EA / (elements * model->L);
  return (ZpMassSpringParams){.ribbons = model->s,
                              .nodes = model->nodes,
                              .lanes = model->stride,
                              .l = model->l,
                              .K_D = def->mass_spring.axial == ZP_AXIAL_TEXT ? text : code,
                              .K_S = isnan(K_S) ? zp_massspring_shear_coefficient(section.EI, model->l, def->mesh.nodes)
                                                : K_S,
                              .left_slope = true,
                              .right_slope = zp_topology_holds_slope(&model->topology, model->nodes - 1, 0)};
}

/* Where the faces are level. Particles of mass_spring have no slope: faces are straight between them. */
static ZpLevelEnds level_faces(const ZpModel *model) {
  return model->is_rod ? zp_topology_level_ends(&model->topology, 0, model->s - 1) : (ZpLevelEnds){0};
}

/* Length of platform at each station that it has, m. */
static double platform_length(const ZpModel *model) {
  return zp_has_platform(&model->topology) ? zp_platform_length(&model->def) / 2 : 0;
}

/* The strength of a layer, as a displacement over eps0; infinite for bare metal, so the other insulator is the weaker
 * one. */
static double strength_of(const ZpActuatorDef *def) {
  return zp_insulator_thickness(def) == 0 ? INFINITY : def->insulator.permittivity * def->insulator.breakdown_field;
}

static ZpSeriesParams series_of(const ZpActuatorDef *upper, const ZpActuatorDef *lower) {
  const ZpActuatorDef *weaker = strength_of(lower) < strength_of(upper) ? lower : upper;
  double thickness = zp_insulator_thickness(upper) / upper->insulator.permittivity +
                     zp_insulator_thickness(lower) / lower->insulator.permittivity;
  return (ZpSeriesParams){thickness, weaker->insulator.permittivity, weaker->insulator.breakdown_field,
                          upper->medium.permittivity};
}

/* Insulators yield by some hundredths of their thickness. An iteration may overlap them by more than all of it; even
 * then the attraction must not exceed the contact force. Bare faces that touch count as a nanometre apart. */
static double least_h(double d) {
  return fmax(0.5 * d, 1e-9);
}

static ZpPlatesParams plates_of(const ZpModel *model) {
  const ZpActuatorDef *def = &model->def;
  double share = model->mirror * def->electro.voltage_share, offset = def->electro.insulator_offset;
  double eps_m = def->medium.permittivity,
         d = model->mirror * (isnan(offset) ? model->series.thickness * eps_m : offset);
  return (ZpPlatesParams){.nodes = model->nodes,
                          .lanes = model->stride,
                          .k = def->electro.force_scale * 0.5 * ZP_EPS0 * eps_m * def->ribbon.width * share * share,
                          .relative = 1,
                          .d = d,
                          .h_per_volt = def->electro.breakdown_cap ? share / def->medium.breakdown_field : 0,
                          .h_least = least_h(d),
                          .h_switch_per_volt = def->electro.switch_offset > 0 ? share / def->medium.breakdown_field : 0,
                          .switch_offset = def->electro.switch_offset,
                          .platform = model->topology.platform.first,
                          .platform_end = model->topology.platform.last,
                          .level = level_faces(model),
                          .flat_length = def->platform.electrode ? platform_length(model) : 0,
                          .flat = model->flat};
}

/* Eq. (25.3). The resistivity of a material that does not conduct is NAN. */
static ZpLeakPatch patch_of(const ZpModel *model, double share, double ratio) {
  const ZpActuatorDef *def = &model->def;
  double insulators = def->insulator.resistivity, liquid = def->medium.resistivity, both = zp_insulation(def);
  double conductance = isnan(insulators) ? 0 : model->mirror * def->ribbon.width / (insulators * both);
  double discharge = isnan(liquid) ? 0 : 1 / (liquid * ZP_EPS0 * def->medium.permittivity);
  return (ZpLeakPatch){share, ratio * conductance, ratio * discharge};
}

/* Eq. (25.10); also of a model that does not leak, whose one patch has no charge. */
static ZpLeakParams leak_of(const ZpModel *model) {
  const double fast = model->def.electro.leak_share, ratio = model->def.electro.leak_ratio;
  return (ZpLeakParams){.insulators = 2 * model->plates.k / model->plates.d,
                        .patches = fast > 0 ? 2 : 1,
                        .patch = {patch_of(model, 1 - fast, 1), patch_of(model, fast, ratio)}};
}

static ZpFieldParams cross_section_of(const ZpModel *model) {
  enum { ALONG = 60 };             /* elements along a ribbon, at least, even if it has few nodes */
  static const double usual = 0.1; /* m */
  static const double clip = 5e-3; /* m, of that: the field behind it is that of its far end, wherever that is */
  const ZpActuatorDef *def = &model->def;
  double size = def->ribbon.length / usual;
  return (ZpFieldParams){.stations = model->nodes,
                         .columns = 2 * ((ALONG + model->nodes - 2) / (model->nodes - 1)),
                         .w = def->ribbon.width,
                         .b = def->ribbon.thickness,
                         .t = zp_insulator_thickness(def),
                         .eps_m = def->medium.permittivity,
                         .eps_i = def->insulator.permittivity,
                         .eps_out = model->has_bead ? 1 : def->medium.permittivity,
                         .clip = clip * size,
                         .platform = def->platform.length / 2,
                         .electrode = def->platform.electrode,
                         .mesh = zp_field_mesh(size)};
}

/* The paper's particles have 1/N each, eq. (6). The rod's nodes have their share of the edges beside them, which keeps
 * the centre of mass. A plate has its layers' at its ends, unless plate.mass gives it. */
double zp_ribbon_mass(const ZpModel *model, size_t j) {
  if (zp_def_has(&model->def, ZP_DEVICE_RIGID))
    return isnan(model->def.plate.mass) && j % model->s > 0 ? zp_ribbon_section(model, 1).mu * platform_length(model)
                                                            : 0;
  return model->is_rod ? node_share(model, j, NULL).mass
                       : zp_ribbon_section(model, 0).mu * model->L / (double)model->def.mesh.nodes;
}

/* Of all that moves with a plate, at one of its ends, kg. */
static double moved_mass(const ZpModel *model) {
  const ZpActuatorDef *def = &model->def;
  return zp_def_has(def, ZP_DEVICE_RIGID) && !isnan(def->plate.mass) ? zp_plate_share(model) * def->plate.mass : 0;
}

/* Mass of clips and platforms at node j, eq. (39.1), kg. */
static double connection_mass(const ZpModel *model, size_t j) {
  return zp_clip_part(model, j) * model->def.clip.mass + zp_platform_part(model, j) * model->def.platform.mass;
}

/* With what hangs on it. */
static double node_mass(const ZpModel *model, size_t j) {
  const ZpTopology *t = &model->topology;
  size_t station = j / t->ribbons;
  bool carries = j == zp_lower(t, station) && station >= t->platform.first && station <= t->platform.last;
  double part = carries ? zp_load_part(model, station) : 0;
  return zp_ribbon_mass(model, j) + connection_mass(model, j) + (carries ? moved_mass(model) : 0) +
         part * (zp_end_share(model) * model->def.load.mass);
}

/* The arrays of a model. */
typedef struct Arrays {
  double *rod_l, *rod_S, *rod_B, *rod_k0;   /* ZpRodParams */
  double *shear_B, *per_moment, *per_force; /* ZpStressParams */
  double *weight, *mass, *pseudo;           /* [stride] */
  double *inverse[2][2], *pair[2][2];       /* ZpAxisMasses, of true and of pseudo-masses, along x and y */
  double *face, *face_x;                    /* [nodes] of a counter electrode */
  double *time, *voltage;                   /* ZpDriveTable */
  ZpSpacePoint *point;                      /* [3 nodes] of each ribbon in space */
  ZpSpaceWarp *warp;                        /* [2 nodes] */
  double *turn;                             /* ZpDriven: [stride], and [stride] of each of its places */
  ZpDrivenPlace *driven;
} Arrays;

static size_t count_driven(const ZpModel *model) {
  size_t count = 0;
  for (size_t r = 0; r < model->s; r++)
    for (size_t k = 0; k < model->ribbon[r].places; k++)
      count += is_driven(&model->ribbon[r].place[k]);
  return count;
}

static size_t reserve(const ZpModel *model, size_t rows, void *block, Arrays *a) {
  ZpArena arena = {block, 0};
  double **of_nodes[] = {&a->rod_l, &a->rod_S,  &a->rod_B,   &a->rod_k0,     &a->weight,
                         &a->mass,  &a->pseudo, &a->shear_B, &a->per_moment, &a->per_force};
  for (size_t k = 0; k < sizeof of_nodes / sizeof of_nodes[0]; k++)
    *of_nodes[k] = zp_arena_take(&arena, model->stride);
  for (size_t k = 0; k < 4; k++) {
    a->inverse[k / 2][k % 2] = zp_arena_take(&arena, model->stride);
    a->pair[k / 2][k % 2] = zp_arena_take(&arena, model->nodes);
  }
  const size_t in_space = zp_is_in_space(model) ? model->count : 0;
  a->point = zp_arena_take_of(&arena, 3 * in_space, sizeof *a->point);
  a->warp = zp_arena_take_of(&arena, 2 * in_space, sizeof *a->warp);
  a->face = zp_arena_take(&arena, model->nodes);
  a->face_x = zp_arena_take(&arena, model->nodes);
  a->time = zp_arena_take(&arena, rows);
  a->voltage = zp_arena_take(&arena, rows);
  a->turn = zp_arena_take(&arena, (1 + count_driven(model)) * model->stride);
  a->driven = zp_arena_take_of(&arena, count_driven(model), sizeof *a->driven);
  return arena.used;
}

/* Upper bound of the stiffness of stretching and bending of one edge for its nodes, N/m: the factor is 16 in the middle
 * of a ribbon, 19.4 where a clip is free to move. */
static double edge_stiffness(const ZpModel *model, double EA, double EI) {
  return 4 * EA / model->l + 20 * EI / (model->l * model->l * model->l);
}

/* This gives a frequency of 1.4 in unit steps, below the limit of relaxation. */
static double pseudo_mass_of(const ZpModel *model) {
  if (!model->is_rod) return 0.5 * (4 * model->spring.K_D + 16 * model->spring.K_S);
  ZpSection one = zp_ribbon_section(model, 0), other = zp_ribbon_section(model, model->s - 1);
  return 0.5 * edge_stiffness(model, fmax(one.EA, other.EA), fmax(one.EI, other.EI));
}

/* Inverse masses along an axis: of nodes, 0 where they are held, and of both nodes of a station as one, 0 where one
 * is. */
static ZpAxisMasses masses_along(size_t axis, const ZpModel *model, const ZpTies *ties, const double *mass,
                                 double *inverse, double *pair) {
  for (size_t j = 0; j < model->count; j++)
    inverse[j] = zp_is_held(ties, 2 * j + axis) ? 0 : 1 / mass[j];
  for (size_t i = 0; i < model->nodes; i++) {
    const ZpTie row = zp_tie_of_pair(model, i, axis);
    double one = inverse[row.coordinate / 2], other = inverse[row.to / 2];
    pair[i] = one > 0 && other > 0 ? 1 / (1 / one + 1 / other) : 0;
  }
  return (ZpAxisMasses){mass, inverse, pair};
}

static void fill_masses(ZpModel *model, const ZpTies *ties, Arrays *a) {
  double *const mass[2] = {a->mass, a->pseudo};
  ZpMasses *const masses[2] = {&model->masses, &model->pseudo};
  double weight = 0;
  model->pseudo_mass = pseudo_mass_of(model);
  for (size_t j = 0; j < model->count; j++) {
    a->mass[j] = node_mass(model, j);
    a->pseudo[j] = model->pseudo_mass;
    a->weight[j] = a->mass[j] * model->def.gravity;
    if (j == zp_load_node(&model->topology)) a->mass[j] += zp_series_inertia(model);
  }
  for (size_t k = 0; k < 2; k++) {
    masses[k]->x = masses_along(0, model, ties, mass[k], a->inverse[k][0], a->pair[k][0]);
    masses[k]->y = masses_along(1, model, ties, mass[k], a->inverse[k][1], a->pair[k][1]);
  }
  const double *moves = model->topology.along ? model->masses.x.inverse : model->masses.y.inverse;
  for (size_t j = 0; j < model->count; j++)
    if (moves[j] > 0) weight += a->weight[j];
  model->total_weight =
      weight / (double)zp_halves(&model->topology) + zp_end_share(model) * fabs(model->def.load.force);
  if (model->network->plane)
    memset(a->weight, 0, model->stride * sizeof *a->weight); /* bodies turn it: system/links.h */
  model->mass = a->mass;
  model->weight = a->weight;
}

static ZpRodParams rod_of(const ZpModel *model, const Arrays *a) {
  const ZpJoint *platform = &model->topology.platform;
  return (ZpRodParams){.ribbons = model->s,
                       .nodes = model->nodes,
                       .lanes = model->stride,
                       .cell = model->l,
                       .l = a->rod_l,
                       .S = a->rod_S,
                       .B = a->rod_B,
                       .k0 = a->rod_k0,
                       .curl = {model->ribbon[0].curl, model->ribbon[1].curl},
                       .side = {model->flat ? -1 : 1, -1},
                       .rigid = platform->first,
                       .rigid_end = platform->last,
                       .lower_turns = zp_platform_turns(&model->topology)};
}

/* Without bending, for the axial springs of mass_spring over an implicit step. */
static void fill_chain(ZpModel *model, Arrays *a) {
  for (size_t j = 0; j + model->s < model->count; j++) {
    a->rod_l[j] = model->l;
    a->rod_S[j] = model->spring.K_D;
  }
  model->rod = rod_of(model, a);
}

/* Eq. (8.9): the joint at a held slope and the next one bend together. */
static void fill_end(ZpModel *model, size_t ribbon, ZpLevelEnd level, Arrays *a) {
  size_t s = model->s, left = level.element * s + ribbon, right = left + s;
  size_t held = level.right ? right : left, next = level.right ? left : right;
  LevelShare share = level_share(model, ribbon, level, NULL);
  double own = share.compliance, beside = 1 / a->rod_B[next], det = own * beside - share.across * share.across;
  a->rod_B[held] = beside / det;
  a->rod_B[next] = own / det;
  ZpRodEnd *end = &model->rod.end[model->rod.ends++];
  *end = (ZpRodEnd){held, next, left, level.right ? left - s : right, -share.across / det};
}

/* Eq. (8.9) wherever something holds a slope. */
static void fill_ends(ZpModel *model, Arrays *a) {
  ZpLevelEnds levels[2];
  for (size_t ribbon = 0; ribbon < model->s; ribbon++)
    levels[ribbon] = zp_topology_level_ends(&model->topology, ribbon, ribbon);
  for (size_t k = 0; k < ZP_MOST_LEVEL_ENDS; k++)
    for (size_t ribbon = 0; ribbon < model->s; ribbon++)
      if (k < levels[ribbon].count) fill_end(model, ribbon, levels[ribbon].of[k], a);
}

/* Natural turns of all joints => turn [stride], rad; of one driven place per its curvature, m. */
static void turns_of(const ZpModel *model, const ZpPlace *driven, double *turn) {
  for (size_t j = 0; j < model->count; j++)
    turn[j] = node_share(model, j, driven).turn;
  for (size_t ribbon = 0; ribbon < model->s; ribbon++) {
    const ZpLevelEnds levels = zp_topology_level_ends(&model->topology, ribbon, ribbon);
    for (size_t k = 0; k < levels.count; k++) {
      const size_t left = levels.of[k].element * model->s + ribbon, right = left + model->s;
      const LevelShare share = level_share(model, ribbon, levels.of[k], driven);
      turn[levels.of[k].right ? right : left] = share.turn;
      turn[levels.of[k].right ? left : right] += share.both_turns;
    }
  }
}

/* Eq. (38.1). Places of the other ribbon bend none of these joints. */
static void fill_driven(ZpModel *model, const ZpPlace *place, size_t ribbon, double *turn, ZpDrivenPlace *driven) {
  *driven = (ZpDrivenPlace){
      .a = place->per_volt, .b = place->per_volt_squared, .lag = place->lag, .first = model->count, .turn = turn};
  turns_of(model, place, turn);
  for (size_t j = ribbon; j < model->count; j += model->s) {
    if (turn[j] == 0) continue;
    driven->end = j + 1;
    if (driven->first > j) driven->first = j;
  }
}

/* Natural curvatures, and how voltage changes them. */
static void fill_natural(ZpModel *model, Arrays *a) {
  size_t places = 0;
  turns_of(model, NULL, a->turn);
  for (size_t j = 0; j < model->count; j++)
    a->rod_k0[j] = zp_driven_natural(a->turn[j]);
  for (size_t r = 0; r < model->s; r++)
    for (const ZpPlace *place = model->ribbon[r].place; place < model->ribbon[r].place + model->ribbon[r].places;
         place++)
      if (is_driven(place)) {
        fill_driven(model, place, r, a->turn + (places + 1) * model->stride, a->driven + places);
        places++;
      }
  model->driven = (ZpDriven){places, a->driven, a->turn};
}

/* A platform that turns does not bend. Its one edge stretches as the ribbon on it does, eq. (19.3). */
static void fill_platform(const ZpModel *model, Arrays *a) {
  const ZpTopology *t = &model->topology;
  size_t j = zp_lower(t, t->platform.first);
  if (!zp_platform_turns(t)) return;
  a->rod_l[j] = model->def.platform.length;
  a->rod_S[j] = zp_ribbon_section(model, 1).EA / model->def.platform.length;
}

/* An edge that is as long as it is laid out has the tension of the strip, eq. (39.3). */
static void fill_edge(const ZpModel *model, size_t j, double compliance, Arrays *a) {
  a->rod_l[j] = model->l - model->def.ribbon.tension * compliance;
  a->rod_S[j] = 1 / compliance;
}

/* Eqs. (8.6): compliance and natural turn of a joint are those of its share of the edges beside it; a free end does not
 * bend, nor a plate. */
static void fill_rod(ZpModel *model, Arrays *a) {
  const ZpTopology *t = &model->topology;
  size_t last = model->nodes - 1;
  for (size_t j = 0; j < model->count; j++) {
    size_t station = j / t->ribbons, element = zp_topology_element_image(t, station);
    Share share = node_share(model, j, NULL);
    bool free = (station == 0 || station == last) && !zp_topology_holds_slope(t, station, j % t->ribbons);
    a->rod_B[j] = free || share.compliance == 0 ? 0 : 1 / share.compliance;
    if (station == last) continue;
    fill_edge(model, j, edge_compliance(model, j % t->ribbons, element), a);
  }
  fill_platform(model, a);
  model->rod = rod_of(model, a);
  fill_ends(model, a);
  fill_natural(model, a);
}

/* Of one layer, whose bending in the plane is that of the rod, eq. (41.1). A narrow strip does not curl. */
static ZpSpaceSection space_section_of(const ZpModel *model) {
  const ZpActuatorDef *def = &model->def;
  ZpSpaceSection section = zp_space_section(def->ribbon.young_modulus, def->ribbon.poisson_ratio, def->ribbon.thickness,
                                            def->ribbon.width, def->ribbon.plane == ZP_PLANE_ANTICLASTIC);
  section.B = zp_ribbon_section(model, 0).EI;
  if (def->ribbon.plane == ZP_PLANE_STRESS) section.squared = 0;
  return section;
}

/* Ends that hold the slope hold the section flat there. */
static void fill_space(ZpModel *model, Arrays *a) {
  const ZpTopology *t = &model->topology;
  for (size_t r = 0; zp_is_in_space(model) && r < model->s; r++) {
    ZpSpaceRodParams *rod = &model->space[r];
    *rod = (ZpSpaceRodParams){.nodes = model->nodes,
                              .l = model->l,
                              .S = zp_ribbon_section(model, r).EA / model->l,
                              .section = space_section_of(model),
                              .from = zp_space_along_x};
    const bool held[] = {zp_topology_holds_slope(t, 0, r), zp_topology_holds_slope(t, model->nodes - 1, r)};
    zp_space_points(rod, held, true, a->point + 3 * model->nodes * r, a->warp + 2 * model->nodes * r);
  }
}

/* The spring in series with the half element that the joint beside it does not bend. */
static ZpHingeParams hinge_of(const ZpModel *model) {
  const ZpActuatorDef *def = &model->def;
  Share share = node_share(model, zp_lower(&model->topology, 0), NULL);
  if (!zp_is_hinge(&model->topology) || def->hinge.stiffness == 0) return (ZpHingeParams){0, 0};
  return (ZpHingeParams){1 / (1 / def->hinge.stiffness + share.compliance), def->hinge.rest_angle - share.turn};
}

/* Height of a counter electrode at x, eq. (35.1), m. */
static double counter_at(const ZpModel *model, double x) {
  const ZpActuatorDef *def = &model->def;
  return def->electro.gap_offset + def->counter.height * zp_power(fmin(x / model->L, 1), def->counter.power);
}

/* The place on it that is an element's length from the one at x, in a straight line, eq. (35.2). */
static double next_on_counter(const ZpModel *model, double x) {
  enum { HALVINGS = 52 };
  const double y = counter_at(model, x);
  double near = 0, far = model->l;
  for (int k = 0; k < HALVINGS; k++) {
    const double middle = 0.5 * (near + far), rise = counter_at(model, x + middle) - y;
    if (middle * middle + rise * rise > model->l * model->l)
      far = middle;
    else
      near = middle;
  }
  return x + far;
}

/* A ribbon that lies on the electrode has its stations there. */
static void fill_face(ZpModel *model, Arrays *a) {
  const bool flat = model->def.counter.height == 0 || model->def.counter.power == 0;
  double x = 0;
  for (size_t i = 0; i < model->nodes; i++) {
    a->face_x[i] = x;
    a->face[i] = counter_at(model, x);
    x = flat ? x + model->l : next_on_counter(model, x);
  }
  model->plates.face = model->air.face = a->face;
  model->face_x = a->face_x;
}

/* Its joints may yield. */
static void fill_plastic(ZpModel *model) {
  if (!model->def.ribbon.plasticity) return;
  ZpActuatorDef room;
  model->plastic[0] = plastic_of(&model->def);
  model->plastic[1] = plastic_of(zp_def_lower(&model->def, &room));
  model->rod.plastic = model->plastic;
}

/* Its layers may creep. */
static void fill_branches(ZpModel *model) {
  ZpActuatorDef room;
  if (!zp_def_creeps(&model->def) || !model->is_rod) return;
  find_branches(&model->def, model->branch);
  find_branches(zp_def_lower(&model->def, &room), model->branch + ZP_BRANCHES);
  model->rod.branch = model->branch;
}

/* All pieces within half an edge of node j count: the largest stress per moment and per force of any of them. */
static void fill_stress_of(const ZpModel *model, size_t j, Arrays *a) {
  const ZpTopology *t = &model->topology;
  size_t ribbon = j % t->ribbons, station = zp_topology_station_image(t, j / t->ribbons);
  for (size_t i = station > 0 ? station - 1 : 0; i <= station && i < zp_half_elements(t); i++) {
    Piece piece[ZP_MOST_PLACES];
    int count = pieces_of(model, ribbon, i, piece);
    for (int k = 0; k < count; k++) {
      bool near = i < station ? piece[k].to > 0.5 : piece[k].from < 0.5;
      if (!near) continue;
      a->per_moment[j] = fmax(a->per_moment[j], piece[k].place->section.per_moment);
      a->per_force[j] = fmax(a->per_force[j], piece[k].place->section.per_force);
    }
  }
}

/* Joints of mass_spring turn against their shear springs. */
static void fill_stress(ZpModel *model, Arrays *a) {
  model->stress = (ZpStressParams){model->rod, !model->is_rod, a->per_moment, a->per_force};
  for (size_t j = 0; j < model->count; j++) {
    bool free = j / model->s + 1 == model->nodes && !model->spring.right_slope;
    fill_stress_of(model, j, a);
    a->shear_B[j] = free ? 0 : model->spring.K_S * model->l * model->l;
  }
  if (!model->is_rod) model->stress.rod.B = a->shear_B;
}

/* Upper bound of the highest frequency, rad/s, eqs. (6.2) and (8.5): an edge of several pieces is as stiff as its
 * stiffest and as light as its lightest. */
static double frequency_bound(const ZpModel *model) {
  double stiffest = 0;
  if (!model->is_rod) return zp_massspring_frequency_bound(&model->spring, zp_ribbon_mass(model, 0));
  const bool alike = model->ribbon[0].places == 1 && model->ribbon[1].places == 1; /* the first edges stand for all */
  const size_t elements = alike ? 1 : zp_half_elements(&model->topology);
  for (size_t j = 0; j < model->s * elements; j++) {
    Piece piece[ZP_MOST_PLACES];
    int count = pieces_of(model, j % model->s, j / model->s, piece);
    double EA = 0, EI = 0, mu = INFINITY;
    for (int k = 0; k < count; k++) {
      EA = fmax(EA, piece[k].place->section.EA);
      EI = fmax(EI, piece[k].place->section.EI);
      mu = fmin(mu, piece[k].place->section.mu);
    }
    stiffest = fmax(stiffest, edge_stiffness(model, EA, EI) / (mu * model->l));
  }
  return sqrt(stiffest);
}

/* Compliance of a layer under a pressure, m/Pa. */
static double compliance_of(const ZpActuatorDef *def) {
  static const double typical = 1e9;      /* Pa, of a polymer tape, where insulator.young_modulus is not given */
  static const double thinnest = 0.26e-6; /* m: two of these have the least range of contact */
  double E = def->insulator.young_modulus > 0 ? def->insulator.young_modulus : typical;
  return fmax(zp_insulator_thickness(def), thinnest) / E;
}

/* Largest attraction of closed faces short of a breakdown, N/m: that of the liquid if the law is capped, else that of
 * the insulators. */
static double largest_attraction(const ZpModel *model) {
  const ZpActuatorDef *def = &model->def;
  const ZpPlatesParams *p = &model->plates;
  double field = def->medium.breakdown_field / def->electro.voltage_share;
  double voltage = zp_series_allowed(&model->series), d = fmax(p->d, p->h_least);
  bool capped = def->electro.breakdown_cap || voltage == 0;
  return p->k * (capped ? field * field : voltage * voltage / (d * d));
}

/* A small part of the time in which a ribbon bends, eq. (18.11), s. */
static double settling_time(const ZpModel *model) {
  static const double part = 1.0 / 16;
  ZpSection section = zp_ribbon_section(model, 0);
  return part * model->L * model->L * sqrt(section.mu / section.EI);
}

/* Force per length of a plate with which its spring would draw it away where its faces touch, N/m. */
static double pull_of_spring(const ZpModel *model) {
  const ZpActuatorDef *def = &model->def;
  return zp_plate_share(model) * def->plate.stiffness * def->plate.gap / platform_length(model);
}

/* Eq. (9.2). A free end may touch alone, as a point, eq. (9.8): its edge presses the layers together over as long a
 * part of them as they are thick. */
static ZpContactParams faces_of(const ZpModel *model, const ZpActuatorDef *lower) {
  static const double part = 1.0 / 150; /* of the liquid thickness that stands for the insulators */
  const ZpActuatorDef *def = &model->def;
  double range = zp_contact_range(zp_insulation(def));
  double depth = fmin(fmax(part * model->plates.d, zp_contact_range(0)), range);
  bool both = zp_def_has(def, ZP_DEVICE_PAIR | ZP_DEVICE_SHAPED);
  double layers = compliance_of(def) + (both ? compliance_of(lower) : 0);
  double stiffest = def->ribbon.width / layers * depth / 3;
  double heavier = fmax(zp_ribbon_section(model, 0).mu, zp_ribbon_section(model, model->s - 1).mu);
  double weight = heavier * def->gravity; /* the load hangs: it does not press faces together */
  bool rigid = zp_def_has(def, ZP_DEVICE_RIGID);
  double stop = rigid ? def->plate.stop_gap : 0, most = fmax(largest_attraction(model), weight);
  double push = fmin(stop > 0 ? fmax(pull_of_spring(model), weight) : most, stiffest);
  return (ZpContactParams){.nodes = model->nodes,
                           .l = model->l,
                           .stop = stop,
                           .range = range,
                           .depth = depth,
                           .push = push,
                           .settling = settling_time(model),
                           .platform = model->topology.platform.first,
                           .platform_end = model->topology.platform.last,
                           .level = level_faces(model),
                           .flat_length = zp_ends_free(&model->topology) ? zp_insulation(def) : platform_length(model)};
}

/* Air beyond a bead. Eq. (8) of the paper caps its attraction even if that of the liquid is not capped. */
static ZpPlatesParams air_of(const ZpModel *model) {
  const ZpActuatorDef *def = &model->def;
  ZpPlatesParams air = model->plates;
  air.k /= def->medium.permittivity;
  air.d /= def->medium.permittivity;
  air.h_least = least_h(air.d);
  air.relative /= def->medium.permittivity;
  air.h_per_volt = def->electro.voltage_share / def->air.breakdown_field;
  return air;
}

/* Beyond the electrodes of a pouch. */
static ZpPlatesParams no_law(const ZpPlatesParams *plates) {
  ZpPlatesParams none = *plates;
  none.k = none.relative = 0;
  return none;
}

/* In the middle of what the electrodes leave open. Heads of a pouch are those over the pressure there, whose volume is
 * fixed, so that nothing leaves. */
static size_t deepest_station(const ZpModel *model) {
  return (size_t)(0.5 * (model->pouch.electrode + model->pouch.length) / model->l);
}

/* Eqs. (22.1) to (22.3). */
static ZpFilmParams film_of(const ZpModel *model) {
  const ZpActuatorDef *def = &model->def;
  const bool rigid = zp_def_has(def, ZP_DEVICE_RIGID);
  ZpFilmParams film = {
      .nodes = model->nodes,
      .l = model->l,
      .platform = model->topology.platform.first,
      .platform_end = model->topology.platform.last,
      .flat_length = platform_length(model),
      .w = def->ribbon.width,
      .mu = model->mirror * model->mirror * def->medium.kinematic_viscosity * def->medium.density,
      .rho = def->liquid.inertia ? def->medium.density : 0,
      .free_path = def->medium.mean_free_path,
      .floor = {rigid && !isnan(def->plate.floor_gap) ? def->plate.floor_gap : 0, def->ribbon.thickness},
      .roughness = model->mirror * zp_def_roughness(def),
      .vent = {model->topology.platform.first, model->topology.platform.last}};
  if (rigid)
    zp_film_plate_modes(&film, def->ribbon.length, def->liquid.lateral_flow);
  else
    zp_film_modes(&film, def->liquid.lateral_flow);
  film.outlet |= zp_ends_free(&model->topology);
  if (model->pouch.w > 0) film.vent[0] = film.vent[1] = deepest_station(model);
  return film;
}

/* A bead and a pouch have air outside; behind a plate there may be a film. */
static ZpOuterParams outer_of(const ZpActuatorDef *def) {
  const bool film = zp_def_has(def, ZP_DEVICE_RIGID) && !isnan(def->plate.back_gap);
  const bool air = zp_def_liquid(def) == ZP_LIQUID_BEAD || zp_def_has(def, ZP_DEVICE_POUCH);
  if (air || film) return (ZpOuterParams){.w = def->ribbon.width};
  return (ZpOuterParams){.w = def->ribbon.width,
                         .rho = def->liquid.inertia ? def->medium.density : 0,
                         .drag = 0.5 * def->medium.drag_coefficient * def->medium.density};
}

/* damping.internal, or the value that auto means: docs/theory.md, section 18. */
static double internal_damping_of(const ZpActuatorDef *def) {
  static const double of_taped_steel = 10e-6; /* s */
  bool damped = zp_def_has(def, ZP_DEVICE_PLATFORM) && !zp_def_has(def, ZP_DEVICE_RIGID) &&
                def->ribbon.model != ZP_RIBBON_MASS_SPRING && def->solver.integrator == ZP_INTEGRATOR_IMPLICIT;
  if (!isnan(def->damping.internal)) return def->damping.internal;
  return damped ? of_taped_steel : 0;
}

/* Mass of the lower platform's end with its load and without the ribbon, kg. */
static double end_mass(const ZpModel *model) {
  return zp_end_share(model) * model->def.load.mass + connection_mass(model, zp_load_node(&model->topology));
}

/* Frequency of faces that overlap by five depths, as in fast impacts, rad/s: two free nodes, or the lower platform
 * below the held one. */
static double contact_frequency(const ZpModel *model) {
  enum { DEPTH = 5 };
  const ZpContactParams *p = &model->faces;
  double stiffness = 3 * p->push * DEPTH * DEPTH / p->depth, half = 0.5 * model->l;
  double mu = fmin(zp_ribbon_section(model, 0).mu, zp_ribbon_section(model, model->s - 1).mu);
  double platform = stiffness * (half + p->flat_length);
  return sqrt(fmax(stiffness / (0.5 * mu), platform / (mu * half + end_mass(model))));
}

/* Frequency of the platform on spring and stop, rad/s. */
static double spring_frequency(const ZpModel *model) {
  const ZpActuatorDef *def = &model->def;
  double mass = zp_ribbon_section(model, model->s - 1).mu * 0.5 * model->l + end_mass(model);
  double stop = isnan(def->load.stop_opening) ? 0 : def->load.stop_stiffness;
  return sqrt(zp_end_share(model) * (def->load.stiffness + stop) / mass);
}

/* Direction of gravity, eq. (27.4). A component that is only the rounding of the angle is set to 0. */
static void find_fall(ZpModel *model) {
  const double turns = model->def.mount.tilt / (2 * zp_pi) + (model->topology.along ? 0.25 : 0),
               roll = model->def.mount.roll / (2 * zp_pi), down = zp_cosine_of(turns),
               fall[3] = {zp_sine_of(turns), -down * zp_cosine_of(roll), -down * zp_sine_of(roll)};
  for (int k = 0; k < 3; k++)
    model->fall[k] = fabs(fall[k]) < zp_tilt_rounding ? 0 : fall[k];
  model->pull[model->topology.along ? 0 : 1] = model->topology.along ? 1 : -1;
}

/* Section 40. One of two films is modelled; pouches in series are alike. */
static void derive_pouch(ZpModel *model) {
  const ZpActuatorDef *def = &model->def;
  double closed = def->ribbon.length - def->pouch.electrode_length, area = def->pouch.fill * closed * closed / zp_pi;
  model->in_series = 1;
  model->mirror = model->stroke_by = 1;
  if (!zp_def_has(def, ZP_DEVICE_POUCH)) return;
  model->pouch = (ZpPouchParams){.w = def->ribbon.width,
                                 .volume = 0.5 * area * def->ribbon.width,
                                 .electrode = def->pouch.electrode_length,
                                 .length = def->ribbon.length};
  model->pouch.volume = zp_pouch_volume_of_chords(&model->pouch, model->nodes);
  model->mirror = 0.5;
  model->in_series = (size_t)def->pouch.count;
  model->stroke_by = -(double)def->pouch.count;
  model->stroke_at = def->pouch.count * zp_pouch_chord(def->ribbon.length, zp_pouch_angle(def->ribbon.length, area));
}

static void derive(ZpModel *model) {
  const ZpActuatorDef *def = &model->def;
  const ZpTopology *t = &model->topology;
  model->topology = zp_topology_of(def);
  bool two = zp_is_pair(t), platform = zp_has_platform(t);
  model->s = t->ribbons;
  model->nodes = t->stations;
  model->count = t->nodes;
  model->stride = zp_round_up(model->count - model->s) + ZP_LANES;
  model->axes = def->ribbon.model == ZP_RIBBON_SPATIAL ? ZP_SPACE_AXES : ZP_PLANE_AXES;
  model->field = zp_def_has(def, ZP_DEVICE_ELECTRODES);
  model->flat = zp_def_has(def, ZP_DEVICE_COUNTER | ZP_DEVICE_POUCH) && !two;
  derive_pouch(model);
  model->parts = platform ? 2 / (double)zp_halves(t) * def->stack.parallel * zp_def_count(def)
                          : (double)model->in_series / model->mirror;
  model->L = platform ? (def->ribbon.length - zp_platform_length(def)) / 2 : def->ribbon.length;
  if (zp_def_has(def, ZP_DEVICE_RIGID)) model->L = def->plate.gap;
  model->l = model->L / fmax((double)zp_half_elements(t), 1);
  ZpActuatorDef room;
  const ZpActuatorDef *lower = zp_def_lower(def, &room);
  model->ribbon[0] = ribbon_of(def, 1);
  model->ribbon[1] = ribbon_of(lower, -1);
  model->series = series_of(def, lower);
  find_fall(model);
  model->is_rod = def->ribbon.model != ZP_RIBBON_MASS_SPRING;
  model->hinge = hinge_of(model);
  model->spring = model->shear = spring_of(model);
  double EA = fmax(zp_ribbon_section(model, 0).EA, zp_ribbon_section(model, model->s - 1).EA);
  model->axial_stiffness = model->is_rod ? EA / model->l : model->spring.K_D;
  if (zp_def_has(def, ZP_DEVICE_RIGID)) model->axial_stiffness = zp_plate_share(model) * def->plate.stiffness;
  model->shear.K_D = 0;
  model->plates = plates_of(model);
  model->field_solved = two && def->electro.model == ZP_ELECTRO_FIELD;
  model->faces = faces_of(model, lower);
  model->film = film_of(model);
  model->has_film = model->field && zp_def_liquid(def) != ZP_LIQUID_NONE;
  model->has_bead = model->has_film && zp_def_liquid(def) == ZP_LIQUID_BEAD;
  model->cross_section = cross_section_of(model);
  model->bead = (ZpBeadParams){.volume = def->bead.volume,
                               .suction = def->bead.suction,
                               .returned = def->bead.returned,
                               .tension = def->medium.surface_tension};
  model->air = model->pouch.w > 0 ? no_law(&model->plates) : air_of(model);
  if (model->has_bead || model->pouch.w > 0) model->plates.air = &model->air;
  model->outer = outer_of(def);
  model->own = model->has_film ? ZP_FILM_MODES : 0;
  model->leaks = model->field && !(isnan(def->insulator.resistivity) && isnan(def->medium.resistivity));
  model->leak = leak_of(model);
  model->internal_damping = internal_damping_of(def);
  for (size_t j = 0; j < model->count; j++)
    model->pouch.mass += zp_ribbon_mass(model, j);
  model->field_scale = def->electro.force_scale * def->electro.voltage_share * def->electro.voltage_share;
  /* 0.8 of the limit of the linear problem: large rotations and squeezed links stay below it. Pairs that join and part
   * from step to step add energy to motion near the limit */
  bool joins_at_will = two && def->contact.model == ZP_CONTACT_UNILATERAL;
  double fastest = frequency_bound(model), contact = joins_at_will ? contact_frequency(model) : 0;
  double spring = spring_frequency(model);
  model->stable_step = (joins_at_will ? 0.5 : 0.8) * 2 / sqrt(fastest * fastest + contact * contact + spring * spring);
}

static ZpStatus check_table(const ZpActuatorDef *def, const ZpDriveTable *table, ZpError *err) {
  size_t row;
  if (!table) return ZP_OK;
  const char *of = def->control.kind == ZP_CONTROL_NONE ? "drive" : "setpoint";
  if (!zp_def_takes_table(def))
    return zp_fail(err, ZP_BAD_INPUT, "%s.waveform: a table was given, which requires %s.waveform table", of, of);
  const char *fault = zp_drive_table_fault(table, &row);
  return fault ? zp_fail(err, ZP_BAD_INPUT, "%s.waveform = table: row %zu: %s", of, row + 1, fault) : ZP_OK;
}

/* Does the pull of the member turn its lower body clockwise in the drawing: about the first pin of that body, or
 * without one about its place? */
static bool closing_turns_back(const ZpModel *model) {
  const ZpNetwork *network = model->network;
  const ZpEnds *ends = &network->ends[model->number];
  const ZpBody *body = &network->body[ends->lower];
  double about[2] = {body->x, body->y};
  for (size_t k = network->joints; k-- > 0;) {
    const ZpBodyJoint *joint = &network->joint[k];
    if (joint->type != ZP_JOINS_PIN || (joint->body[0] != ends->lower && joint->body[1] != ends->lower)) continue;
    about[0] = joint->at[0];
    about[1] = joint->at[1];
  }
  const ZpVector at = zp_turned(zp_direction(body->angle), (ZpVector){ends->at[1][0], ends->at[1][1]});
  const ZpVector from = {body->x + at.x - about[0], body->y + at.y - about[1]};
  return zp_along(from, zp_direction(ends->angle)) < 0; /* the pull is across that direction */
}

static void fill_waveform(ZpModel *model, const ZpDriveTable *table, Arrays *a) {
  size_t bytes = table ? table->rows * sizeof *a->time : 0;
  const bool is_drive = model->def.control.kind == ZP_CONTROL_NONE;
  if (bytes) {
    memcpy(a->time, table->time, bytes);
    for (size_t k = 0; k < table->rows; k++)
      a->voltage[k] = (is_drive ? model->ratio : 1) * table->voltage[k];
  }
  const ZpDriveTable copy = {table ? table->rows : 0, a->time, a->voltage}; /* of the one whose waveform is a table */
  model->waveform = zp_waveform_of(&model->def, &copy);
  model->setpoint = zp_setpoint_of(&model->def, &copy);
  model->control = zp_control_of(&model->def);
  if (model->def.control.signal == ZP_CONTROL_ANGLE && model->network->plane && closing_turns_back(model))
    model->control.sense = 1;
  model->supply = zp_supply_of(&model->def);
  model->supply.acts &= model->field;
}

#ifndef ZP_WITHOUT_FIELD
/* The cross-section of a ribbon, or of a rigid plate, over a counter electrode. Bare metals are followed down to a
 * tenth of their gap, far beyond pull-in. */
static void put_over_plate(const ZpModel *model, ZpEdgeParams *params) {
  static const double tenth = 0.1;
  ZpActuatorDef room;
  const ZpActuatorDef *lower = zp_def_lower(&model->def, &room);
  double least = model->flat ? INFINITY : model->def.plate.gap;
  for (size_t i = 0; model->flat && i < model->nodes; i++)
    least = fmin(least, model->plates.face[i]);
  params->plate = true;
  params->plate_t = lower->insulator.thickness;
  params->plate_eps = lower->insulator.permittivity;
  params->least = tenth * least;
}

/* A gap larger than that of ribbons that hang straight down, m. */
static double largest_gap(const ZpModel *model) {
  static const double halves = 2.5, bend = 1.25; /* of the flexible length: two ribbons, one */
  double most = 0;
  for (size_t i = 0; model->flat && i < model->nodes; i++)
    most = fmax(most, model->plates.face[i]);
  return model->flat ? most + bend * model->L : halves * model->L;
}

/* Contribution of the lateral edges. */
static ZpStatus make_edges(ZpModel *model, ZpError *err) {
  const ZpActuatorDef *def = &model->def;
  if (!model->field || !def->electro.edges) return ZP_OK;
  ZpEdgeParams params = {.w = def->ribbon.width,
                         .b = def->ribbon.thickness,
                         .t = def->insulator.thickness,
                         .eps_m = def->medium.permittivity,
                         .eps_i = def->insulator.permittivity};
  if (zp_def_has(def, ZP_DEVICE_COUNTER)) put_over_plate(model, &params);
  model->plates.edges = &model->edge_law;
  ZpStatus status = zp_edges_make(&params, largest_gap(model), &model->edge_law, err);
  if (status != ZP_OK || !model->has_bead) return status;
  params.eps_m = 1;
  model->air.edges = &model->air_edges;
  return zp_edges_make(&params, largest_gap(model), &model->air_edges, err);
}
#endif

/* Is the layout that its device made one that a model can have? */
static ZpStatus check_layout(const ZpModel *model, ZpError *err) {
  const char *fault = zp_topology_fault(&model->topology);
  if (!fault) return ZP_OK;
  return zp_fail(err, ZP_BAD_INPUT, "actuator.kind = %s: layout of the device: %s",
                 zp_def_word(&model->def, "actuator.kind"), fault);
}

/* Its arrays. */
static ZpStatus fill(const ZpTies *ties, const ZpDriveTable *table, ZpModel *model, ZpError *err) {
  size_t rows = table ? table->rows : 0;
  Arrays arrays;
  model->memory = zp_calloc(1, reserve(model, rows, NULL, &arrays));
  ZpStatus status = model->memory ? ZP_OK : zp_fail_memory(err);
  if (status != ZP_OK) return status;
  reserve(model, rows, model->memory, &arrays);
  fill_face(model, &arrays);
#ifndef ZP_WITHOUT_FIELD
  status = make_edges(model, err);
  if (status != ZP_OK) return status;
#endif
  fill_waveform(model, table, &arrays);
  if (model->is_rod)
    fill_rod(model, &arrays);
  else
    fill_chain(model, &arrays);
  fill_space(model, &arrays);
  fill_plastic(model);
  fill_branches(model);
  fill_stress(model, &arrays);
  fill_masses(model, ties, &arrays);
  return ZP_OK;
}

/* Its mass with its load, kg. */
static double mass_of(const ZpModel *model) {
  double sum = 0;
  for (size_t j = 0; j < model->count; j++)
    sum += model->mass[j];
  return model->parts * sum;
}

/* Alone in equilibrium, the uppermost member has all that hangs on it as load.mass. */
static ZpStatus check_carried(const ZpModel *uppermost, ZpError *err) {
  double most = zp_key(zp_key_find("load.mass"))->max, hangs = uppermost->def.load.mass + uppermost->carried;
  if (hangs <= most) return ZP_OK;
  return zp_fail(err, ZP_BAD_INPUT,
                 "load.mass: with members and links of stack.series %g kg hang on the uppermost, more than %g kg",
                 hangs, most);
}

/* One actuator, or one member of a stack. */
static void derive_member(const ZpActuatorDef *def, size_t member, ZpModel *model) {
  model->def = model->members > 1 || zp_def_network(def) ? zp_def_member(def, (int)member + 1) : *def;
  model->def.given = NULL;
  model->ratio = 1;
  derive(model);
  model->bias = zp_def_member_voltage(def, (int)member + 1, 0);
  model->ratio = zp_def_member_voltage(def, (int)member + 1, 1) - model->bias;
  model->apart = zp_def_port(def, (int)member + 1) > 0;
}

/* Mass of what hangs on each member. Those of a network may be named in any order. */
static void carry(ZpModel *model) {
  const ZpNetwork *network = model->network;
  for (size_t k = model->members; k-- > 0;) {
    const double mass = mass_of(model + k);
    for (size_t body = network->ends[k].upper; !network->body[body].held;) {
      const size_t above = network->body[body].leader;
      model[above].carried += mass;
      body = network->ends[above].upper;
    }
  }
}

static ZpStatus fill_all(const ZpActuatorDef *def, const ZpDriveTable *table, ZpModel *model, ZpError *err) {
  ZpStatus status = ZP_OK;
  for (size_t k = 0; k < model->members; k++)
    derive_member(def, k, model + k);
  for (size_t k = model->members; k-- > 0 && status == ZP_OK;) {
    const ZpTies ties = zp_ties_of(model, model->members, k);
    status = check_layout(model + k, err);
    if (status == ZP_OK) status = fill(&ties, table, model + k, err);
  }
  if (status == ZP_OK && !zp_shares_load(model)) carry(model);
  if (status == ZP_OK) status = zp_plane_check(model, err);
  return status == ZP_OK && model->members > 1 ? check_carried(model, err) : status;
}

/* Of a definition that has been checked. */
static ZpStatus build(const ZpActuatorDef *def, const ZpDriveTable *table, ZpModel **out, ZpError *err) {
  size_t members = (size_t)zp_def_members(def);
  ZpModel *model = zp_calloc(members, sizeof *model);
  if (!model) return zp_fail_memory(err);
  ZpActuatorDef *whole = zp_def_copy(def);
  ZpNetwork *network = zp_network_create(def);
  for (size_t k = 0; k < members; k++) {
    model[k].members = members;
    model[k].number = k;
    model[k].whole = whole;
    model[k].network = network;
  }
  ZpStatus status = whole && network ? fill_all(def, table, model, err) : zp_fail_memory(err);
  if (status == ZP_OK)
    *out = model;
  else
    zp_model_destroy(model);
  return status;
}

ZpStatus zp_model_build(const ZpActuatorDef *def, const ZpDriveTable *table, ZpModel **out, ZpError *err) {
  *out = NULL;
  ZpStatus status = zp_def_check(def, err);
  if (status == ZP_OK) status = check_table(def, table, err);
  return status == ZP_OK ? build(def, table, out, err) : status;
}

ZpStatus zp_model_build_on_mesh(const ZpModel *model, int nodes, ZpModel **out, ZpError *err) {
  *out = NULL;
  ZpActuatorDef def = *model->whole;
  def.mesh.nodes = nodes;
  return build(&def, NULL, out, err);
}

void zp_model_destroy(ZpModel *model) {
  for (size_t k = 0; model && k < model->members; k++)
    zp_free(model[k].memory);
  if (model) zp_def_destroy(model->whole);
  if (model) zp_free(model->network);
  zp_free(model);
}

const ZpActuatorDef *zp_model_def(const ZpModel *model) {
  return &model->def;
}

size_t zp_state_size(const ZpModel *model) {
  return sizeof(ZpState) + (6 * zp_coordinates(model) + zp_extra_unknowns(model) + model->kept + model->ledger.rows +
                            zp_state_bodies_size(model) + zp_state_pushes_size(model)) *
                               sizeof(double);
}
