/* The inside of a model, a state and an eval: what actuator/, run/ and study/ share.
 *
 * Node i of ribbon r is at [i * s + r] (topology.h). Arrays over nodes have `stride` places, a multiple of ZP_LANES, so
 * that kernels need no remainder, over edges either; places beyond `count` hold nodes that lie on the prolonged ribbon,
 * weigh nothing and never move. Coordinates q hold all x, then all y, in space also all z and the angles of all edges,
 * `stride` apart; velocities v and accelerations a likewise.
 */
#ifndef ZP_ACTUATOR_MODEL_H
#define ZP_ACTUATOR_MODEL_H

#include <math.h>

#include <zipact/model.h>

#include "actuator/topology.h"
#include "base/row.h"
#include "contact/contact.h"
#include "def/network.h"
#include "drive/control.h"
#include "drive/supply.h"
#include "electro/edges.h"
#include "electro/field.h"
#include "electro/leak.h"
#include "electro/plates_step.h"
#include "electro/series.h"
#include "liquid/bead.h"
#include "liquid/film.h"
#include "liquid/outer.h"
#include "liquid/pouch.h"
#include "paper/massspring.h"
#include "paper/surface.h"
#include "paper/zip.h"
#include "ribbon/driven.h"
#include "ribbon/rod_step.h"
#include "ribbon/section.h"
#include "ribbon/space_rod.h"
#include "ribbon/stress.h"

/* Masses along one axis. */
typedef struct ZpAxisMasses {
  const double *mass;    /* [stride] of each node, kg */
  const double *inverse; /* [stride] 1 / mass; 0 where the node is held */
  const double *pair;    /* [nodes] 1 / mass of both nodes of a station; 0 where one is held */
} ZpAxisMasses;

/* For true and for pseudo-masses. */
typedef struct ZpMasses {
  ZpAxisMasses x, y;
} ZpMasses;

/* Section of a ribbon along a part of it, to `end` from its left end, m. */
typedef struct ZpPlace {
  ZpSection section;
  double curvature;                  /* natural, 1/m, */
  double per_volt, per_volt_squared; /* and what voltage drives beside it, 1/(m V), 1/(m V^2), */
  double lag;                        /* with a lag, s */
  double end;
} ZpPlace;

/* The places from the left end on: segments with a length, then the rest, without end. */
enum { ZP_MOST_PLACES = ZP_MOST_SEGMENTS + 1 };
typedef struct ZpRibbon {
  ZpPlace place[ZP_MOST_PLACES];
  size_t places; /* 1: no segment has a length */
  double yields; /* yield stress of its metal, Pa */
  ZpCurl curl;   /* across its width */
} ZpRibbon;

/* The spring of a hinge, between the upper ribbon's direction there and the first element of the lower ribbon, which is
 * bent by half of itself. Eq. (30.1). */
typedef struct ZpHingeParams {
  double stiffness; /* N m/rad; 0: there is no spring */
  double rest;      /* angle without a moment, positive downwards, rad */
} ZpHingeParams;

/* Rows, each with a number. Models of one program have the same rows, whichever laws they have, so that a state of one
 * is a state of a neighbour; laws of a program's own add rows. */
enum { ZP_MOST_TERMS = 32, ZP_MOST_ROWS = 44, ZP_ROWS_OF_TERM = 8 };
typedef struct ZpLedger {
  const ZpRow *row[ZP_MOST_ROWS]; /* the first one is the kinetic energy of nodes */
  size_t rows;
} ZpLedger;

struct ZpTerm;

/* A law of a model (term/term.h), and where its numbers stand. */
typedef struct ZpLaw {
  const struct ZpTerm *term;
  size_t row[ZP_ROWS_OF_TERM]; /* numbers of its rows in the ledger */
  size_t rows;
  size_t at, state; /* its state: place of the first number in the state of all laws, and how many */
} ZpLaw;

struct ZpModel {
  ZpActuatorDef def;
  ZpActuatorDef *whole;     /* of the system whose member it is; the first one owns it */
  ZpLaw law[ZP_MOST_TERMS]; /* in the order in which they are added */
  size_t laws;
  unsigned char losing[ZP_MOST_TERMS]; /* numbers of the laws that lose energy over a span */
  size_t losers;
  ZpLedger ledger;
  ZpTopology topology;
  size_t s, nodes, count; /* of it: ribbons, stations, nodes */
  size_t stride;          /* count, rounded up */
  size_t axes;            /* coordinates of a node: ZP_PLANE_AXES or ZP_SPACE_AXES */
  bool field;             /* there are electrodes that attract each other */
  bool field_solved;      /* in two dimensions, beyond the plates law */
  bool flat;              /* one ribbon below a rigid electrode */
  double parts;           /* how many modelled parts make the whole actuator: 2 halves, or 1, or plate.count; of each in
                             parallel */
  double L, l;            /* flexible length of a half or of the one ribbon, element, m; of a plate its gap */
  ZpRibbon ribbon[2];     /* upper or only one, lower one */
  double axial_stiffness; /* of the stiffest edge, of a plate of its spring, N/m */
  bool is_rod;            /* mechanics: rod, else spring */
  ZpHingeParams hinge;    /* of two ribbons on one */
  ZpMassSpringParams spring;
  ZpMassSpringParams shear;          /* the same without axial springs */
  ZpRodParams rod;                   /* of mass_spring its axial springs only */
  ZpSpaceRodParams space[2];         /* of each ribbon, in space */
  ZpDriven driven;                   /* natural curvature that voltage drives */
  ZpPlastic plastic[2];              /* of each ribbon, where ribbon.plasticity */
  ZpMaxwell branch[2 * ZP_BRANCHES]; /* of its layers, where they creep */
  ZpStressParams stress;
  ZpSeriesParams series; /* insulators and liquid between the electrodes */
  ZpPlatesParams plates;
  const double *face_x;  /* [nodes] x of the places of a counter electrode that stations face, m, eq. (35.2) */
  ZpContactParams faces; /* of unilateral contact */
  bool has_film;         /* of liquid between the faces */
  ZpFilmParams film;
  bool leaks; /* insulators or liquid conduct */
  ZpLeakParams leak;
  bool has_bead; /* the film ends, and beyond it is air */
  ZpBeadParams bead;
  ZpPlatesParams air; /* the law there; of a pouch that beyond its electrodes: none */
  ZpPouchParams pouch;
  ZpOuterParams outer;           /* of liquid outside */
  size_t own;                    /* unknowns of the laws at each station, in motion */
  size_t kept;                   /* numbers of state of all laws, in motion */
  double internal_damping;       /* s */
  ZpEdgeLaw edge_law, air_edges; /* of plates and air, where electro.edges */
  ZpFieldParams cross_section;
  ZpWaveform waveform;
  ZpSupply supply;
  ZpControl control;
  ZpWaveform setpoint; /* of the controller, in the unit of its signal */
  double field_scale;  /* force_scale * voltage_share^2 */
  ZpMasses masses;     /* true masses */
  ZpMasses pseudo;     /* for settling: all free nodes move at the same pace */
  double pseudo_mass;  /* kg, in units of the pseudo-time step */
  size_t in_series;    /* equal pouches: each is a part, and all have the same load; else 1 */
  double mirror;       /* share of gaps and voltage that is on this side of the middle plane: 1/2 of a pouch, else 1 */
  double stroke_by, stroke_at; /* the stroke is the first times how far the load hangs (zp_hangs_by), plus this, m */
  double fall[3];              /* direction of gravity: a unit vector */
  double pull[2];              /* that in which load.force acts */
  const double *weight;        /* [stride] of each node with its load, N */
  const double *mass;          /* [stride] kg */
  double total_weight;         /* of what moves, of one half, N */
  double stable_step;          /* s */
  void *memory;                /* the block that holds the arrays */
  size_t members;              /* of the system: models that follow each other, in series from the uppermost one down */
  size_t number;               /* which of them it is, from 0 */
  ZpNetwork *network;          /* what joins them; the first one owns it */
  double carried;              /* mass of all members and loads below, kg, of the whole actuator */
  double ratio, bias;          /* its slow voltage: `ratio` times drive.voltage of all plus `bias`, V */
  bool apart;                  /* on another port than that of all: in motion it has the voltage of that port */
};

/* Bounds of an opening, m, in cells of the time for which the actuator has been closed. Cell k is at place k modulo
 * ZP_STILL_CELLS: as many are kept as the last 0.1 s can meet (run/still.h). */
enum { ZP_STILL_CELLS = 17 };
typedef struct ZpStill {
  double least[ZP_STILL_CELLS], most[ZP_STILL_CELLS];
} ZpStill;

/* All that evolves. One block of zp_state_size bytes: inside one simulation a copy of it is a way back; what leaves it
 * is a snapshot (run/snapshot.h). */
typedef struct ZpState {
  double t;     /* s */
  double U;     /* potential difference, V */
  bool by_hand; /* the user has set it: the waveform does not count any more */
  ZpZipState zip;
  bool was_open;      /* has the opening been above 1 % of the hanging one? */
  double zip_time;    /* s; NAN until zipped */
  double closed_from; /* since when it has been closed, after zip_time, s; NAN: it is open */
  ZpStill still;      /* while it is closed */
  double opening0;    /* of the hanging equilibrium, m */
  double base_U;      /* voltage since the account of work was last closed, V; where U is another, it has jumped
                         there now */
  double base_charge; /* per part: from which the account counts charge, C */
  double work;        /* per part: of the source, without base_U (charge - base_charge), J */
  bool load_changed;  /* load.change_mass has been caught or dropped, */
  double changed_x;   /* where its node was then, m */
  double changed_y;
  double last_step;        /* implicit: length of the last step, s; 0: there is none */
  double next_step;        /* and of the next one to try */
  double refreshed;        /* time of the last refresh of a held electric force, s; NAN: due now */
  double held_U;           /* voltage at that refresh, V */
  double held_energy;      /* per part, at the last refresh: co-energy of the field beyond plates, J/V^2, */
  double held_charge;      /* and charge, C/V */
  double held_capacitance; /* and capacitance, F */
  ZpRamp voltage_input;    /* V; counts where by_hand */
  ZpRamp load_input;       /* N, down on the lower platform (one ribbon: the right end) of the whole actuator */
  double load_work;        /* per part: of that force so far, J */
  ZpControlState control;  /* of the model's controller */
  bool setpoint_by_hand;   /* the user has set it: its waveform does not count any more */
  ZpRamp setpoint_input;   /* in the unit of the signal; counts where setpoint_by_hand */
  ZpSupplyState supply;    /* behind a supply: what of it evolves, */
  size_t supply_mode;      /* which of its limits acts (run/supply_coupling.c), */
  double source_charge;    /* and of the whole actuator: charge that it has given, C, */
  double source_energy;    /* and energy, J */
  double leaked;           /* per part: charge that has passed through the insulators, C */
  ZpBead bead[ZP_BEADS];   /* of each half */
  double link_force;       /* of members side by side: force with which links push this one's platform up, the mean
                              over the last step, N per part */
  double starved_time;     /* when a zip front had outrun its bead, s; NAN: it has not */
  double U_rate,
      U_change;  /* implicit, behind a source: mean rate of U over the last step, V/s, and its change, V/s^2 */
  double data[]; /* of all coordinates: q, v, held force, where it was found, mean velocity and acceleration of the last
                    implicit step; the laws' own unknowns [own N]
                    and state [kept], the ledger [rows]; of the first member bodies in the plane (zp_state_bodies) */
} ZpState;

/* Bytes. */
size_t zp_state_size(const ZpModel *model);

/* How many numbers q has. */
static inline size_t zp_coordinates(const ZpModel *model) {
  return model->axes * model->stride;
}

/* Do ribbons leave the plane? */
static inline bool zp_is_in_space(const ZpModel *model) {
  return model->axes == ZP_SPACE_AXES;
}

/* Directions in which its nodes move: x, y, in space also z. */
static inline size_t zp_directions(const ZpModel *model) {
  return zp_is_in_space(model) ? 3 : 2;
}

/* Where the coordinates and velocities of a state stand. */
static inline double *zp_state_q(const ZpModel *model, ZpState *state) {
  (void)model;
  return state->data;
}

static inline double *zp_state_v(const ZpModel *model, ZpState *state) {
  return state->data + zp_coordinates(model);
}

/* Does a voltage act on anything: electrodes that attract, or curvature that it drives? */
static inline bool zp_follows_voltage(const ZpModel *model) {
  return model->field || model->driven.places > 0;
}

/* Section of a ribbon beyond its segments. */
static inline ZpSection zp_ribbon_section(const ZpModel *model, size_t ribbon) {
  return model->ribbon[ribbon].place[model->ribbon[ribbon].places - 1].section;
}

/* Derivatives of a ribbon's EA, EI and mu by a key of the model, where all of its places have one section, or by the
 * width; the others are 0. False: they have no closed form. */
bool zp_ribbon_by_key(const ZpModel *model, size_t ribbon, int key, ZpSection *rate);

/* Mass of the ribbon at node j, without what hangs there, kg. */
double zp_ribbon_mass(const ZpModel *model, size_t j);

/* Part of clip.mass that node j has, eq. (39.1): a half at both nodes of a clip. */
static inline double zp_clip_part(const ZpModel *model, size_t j) {
  return zp_is_clip(&model->topology, j / model->s) ? 0.5 : 0;
}

/* Part of platform.mass that node j has, eq. (39.1): a half at both ends of each platform. */
static inline double zp_platform_part(const ZpModel *model, size_t j) {
  const ZpTopology *t = &model->topology;
  size_t station = j / t->ribbons;
  return zp_has_platform(t) && station >= t->platform.first && station <= t->platform.last ? 0.5 : 0;
}

/* The fraction of the load that each modelled end carries on which it hangs. */
static inline double zp_end_share(const ZpModel *model) {
  return model->def.load.share / (model->def.stack.parallel * (double)zp_def_count(&model->def));
}

/* One of a plate's springs, or its mass, as a fraction at each of its ends. */
static inline double zp_plate_share(const ZpModel *model) {
  return model->def.stack.parallel / (model->parts * (double)zp_halves(&model->topology));
}

/* Equal pouches in series move their load together: to one of them it has more inertia than weight by so much, eq.
 * (40.8), kg. */
static inline double zp_series_inertia(const ZpModel *model) {
  return ((double)model->in_series - 1) * zp_end_share(model) * model->def.load.mass;
}

/* Factor on that for the platform's end at a station: 1, or by (19.4) of a load that hangs off the centre. */
static inline double zp_load_part(const ZpModel *model, size_t station) {
  const ZpTopology *t = &model->topology;
  if (model->def.load.offset == 0) return 1;
  return 1 + (station == t->platform.last ? 2 : -2) * model->def.load.offset / zp_platform_length(&model->def);
}

/* (one coordinate of all nodes) => that of the point that the load hangs on. */
static inline double zp_load_at(const ZpModel *model, const double *q) {
  const ZpTopology *t = &model->topology;
  double sum = 0;
  for (size_t i = t->platform.first; i <= t->platform.last; i++)
    sum += zp_load_part(model, i) * q[zp_lower(t, i)];
  return sum / (double)zp_halves(t);
}

/* (coordinates of all nodes, or their changes) => how far the point that the load hangs on is in the direction in which
 * load.force acts, m. */
static inline double zp_load_down(const ZpModel *model, ZpNodes n) {
  return model->pull[0] * zp_load_at(model, n.x) + model->pull[1] * zp_load_at(model, n.y);
}

/* Share of the load that the modelled part carries: load.share at each end. */
static inline double zp_load_share(const ZpModel *model) {
  return (double)zp_halves(&model->topology) * zp_end_share(model);
}

/* Parts that bear the load side by side. */
static inline double zp_parts_abreast(const ZpModel *model) {
  return model->parts / (double)model->in_series;
}

/* Force of the whole actuator's load downwards, N: load.force and the part of its weight that acts downwards. */
static inline double zp_load_pull(const ZpModel *model) {
  const ZpActuatorDef *def = &model->def;
  return zp_parts_abreast(model) * zp_load_share(model) *
         (def->load.force +
          def->load.mass * def->gravity * (model->fall[0] * model->pull[0] + model->fall[1] * model->pull[1]));
}

/* (coordinates of all nodes) => stroke, m; (their changes or rates) => its own. */
static inline double zp_stroke(const ZpModel *model, ZpNodes nodes) {
  return model->stroke_by * zp_hangs_by(&model->topology, nodes) + model->stroke_at;
}

static inline double zp_stroke_change(const ZpModel *model, ZpNodes changes) {
  return model->stroke_by * zp_hangs_by(&model->topology, changes);
}

/* (stroke of a pouch, m) => its strain. */
static inline double zp_pouch_strain(const ZpModel *model, double stroke) {
  return stroke / ((double)model->in_series * model->pouch.length);
}

/* Work against this pull, J, while the point that the load hangs on moves by (along, up), m. */
static inline double zp_load_work(const ZpModel *model, double along, double up) {
  const ZpActuatorDef *def = &model->def;
  double weight = def->load.mass * def->gravity;
  double work = -def->load.force * (model->pull[0] * along + model->pull[1] * up) -
                weight * (model->fall[0] * along + model->fall[1] * up);
  return model->parts * zp_load_share(model) * work;
}

/* Do its bodies have loads of their own, as keys say, so that there is no load of all? */
static inline bool zp_is_network(const ZpModel *model) {
  return model->network->load == model->network->bodies;
}

/* Is there one angle to tell of? In a network bodies have theirs. */
static inline bool zp_tells_angle(const ZpModel *model) {
  return zp_has_angle(&model->topology) && !zp_is_network(model);
}

/* How many members lie side by side with this one, itself included. */
static inline size_t zp_abreast(const ZpModel *model) {
  return model->network->ends[model->number].abreast;
}

/* drive.voltage of all members, V. */
static inline double zp_drive_voltage(const ZpModel *model) {
  return model->whole->drive.voltage;
}

/* Slow voltage of a member where drive.voltage of all is `voltage`, V. */
static inline double zp_member_voltage(const ZpModel *model, double voltage) {
  return model->ratio * voltage + model->bias;
}

/* In motion: that of its port, or on the port of all the same relation as that of slow voltages. The part of the
 * port's, and what a constant source of its own adds, V. */
static inline double zp_part_of_port(const ZpModel *model) {
  return model->apart ? 1 : model->ratio;
}

static inline double zp_beside_port(const ZpModel *model) {
  return model->apart ? 0 : model->bias;
}

static inline double zp_voltage_at_port(const ZpModel *model, double voltage) {
  return zp_part_of_port(model) * voltage + zp_beside_port(model);
}

/* That of a port, by its first member, where drive.voltage of all is `voltage`, V. */
static inline double zp_port_voltage(const ZpModel *lead, double voltage) {
  return lead->apart ? zp_member_voltage(lead, voltage) : voltage;
}

/* Is a member of the system, of which this is the first, on a port of its own? */
static inline bool zp_has_ports(const ZpModel *first) {
  bool apart = false;
  for (const ZpModel *model = first; model < first + first->members; model++)
    apart |= model->apart;
  return apart;
}

/* Is it the first of those on its port, which has the source? */
static inline bool zp_leads_port(const ZpModel *model) {
  return model->network->ends[model->number].port == model->number;
}

/* The next member on its port, as a number after its own; 0: none. */
static inline size_t zp_next_on_port(const ZpModel *model) {
  const size_t next = model->network->ends[model->number].next;
  return next > 0 ? next - model->number : 0;
}

/* Charge that the source gives for a charge on one part of a member, eq. (23.8). */
static inline double zp_source_share(const ZpModel *model) {
  return zp_part_of_port(model) * model->parts;
}

/* Do all members share one load, at the lower platform of each? */
static inline bool zp_shares_load(const ZpModel *model) {
  return !model->network->hangs;
}

/* The member on which the load hangs: of a series the lowest one, of members that share the load the first one, whose
 * height is that of the load. */
static inline const ZpModel *zp_lowest(const ZpModel *first) {
  return zp_shares_load(first) ? first : first + first->members - 1;
}

/* Pull of the load of all members, of which this is the first one, N. */
static inline double zp_total_pull(const ZpModel *first) {
  double pull = 0;
  for (const ZpModel *model = zp_lowest(first); model < first + first->members; model++)
    pull += zp_load_pull(model);
  return pull;
}

/* Mass that each end which the load hangs on has beyond its share of load.mass, kg. */
static inline double zp_state_added(const ZpModel *model, const ZpState *state) {
  return state->load_changed ? zp_end_share(model) * model->def.load.change_mass : 0;
}

/* Its weight, of the modelled part, N. */
static inline double zp_state_hung(const ZpModel *model, const ZpState *state) {
  return (double)zp_halves(&model->topology) * zp_state_added(model, state) * model->def.gravity;
}

/* The part of the load input that the modelled part carries at time t, N, as load.share says of the mass. */
static inline double zp_state_load(const ZpModel *model, const ZpState *state, double t) {
  return zp_load_share(model) * zp_ramp_value(&state->load_input, t);
}

/* Where a station of the straight actuator is, m; beyond the right end, of the prolonged ribbon. */
static inline double zp_straight_x(const ZpModel *model, size_t station) {
  const ZpJoint *platform = &model->topology.platform;
  double rigid = (double)(platform->last - platform->first);
  return (double)station * model->l +
         (station < platform->last ? 0 : rigid * (zp_platform_length(&model->def) - model->l));
}

/* Coordinates of an actuator whose lengths L are `stretch` times these ones, laid so that the platform has its own
 * length; those of a plate stay. */
static inline void zp_stretch(const ZpModel *model, double stretch, double *q) {
  const ZpJoint *platform = &model->topology.platform;
  if (zp_half_elements(&model->topology) == 0) return;
  for (size_t k = 0; k < zp_directions(model) * model->stride; k++)
    q[k] *= stretch;
  if (platform->first == platform->last) return;
  size_t right = zp_upper(&model->topology, platform->last);
  double shift = zp_straight_x(model, platform->last) - q[right];
  for (size_t j = right; j < model->stride; j++)
    q[j] += shift;
}

static const double zp_still_open = 0.01; /* part of the way at which an actuator counts as closed */

/* Stations whose mean gap tells whether the actuator is closed: both ends of a platform; else twice the free or guided
 * end, the middle between two clamps, or, of a pouch, where nearly all of its electrodes lie behind. */
typedef struct ZpLast {
  size_t station[2];
} ZpLast;

static inline ZpLast zp_last_to_close(const ZpModel *model) {
  static const double rounding = 1e-9;
  const ZpJoint *end = &model->topology.platform;
  double zipped = (1 - zp_still_open) * model->pouch.electrode / model->l;
  size_t only = model->topology.along ? (size_t)ceil(zipped - rounding) : end->first / 2;
  bool ends = !model->topology.along && end->kind != ZP_JOINT_CLAMP;
  return ends ? (ZpLast){{end->first, end->last}} : (ZpLast){{only, only}};
}

/* Where one ribbon is widest open among the stations that have to close: the last; of a pouch any up to it, because its
 * front may leave liquid behind. */
static inline size_t zp_widest_station(const ZpModel *model, const double *y) {
  size_t last = zp_last_to_close(model).station[0], widest = last;
  for (size_t i = model->topology.along ? 1 : last; i < last; i++)
    if (zp_plates_gap(&model->plates, y, i) > zp_plates_gap(&model->plates, y, widest)) widest = i;
  return widest;
}

/* (heights of nodes, rates of them) => the gap there, m, and how fast it grows; of a pair its opening. NAN where
 * nothing closes. */
static inline double zp_last_gap(const ZpModel *model, const double *y) {
  if (!model->flat) return zp_opening(&model->topology, y);
  return zp_plates_gap(&model->plates, y, zp_widest_station(model, y));
}

static inline double zp_last_gap_rate(const ZpModel *model, const double *y, const double *v) {
  if (!model->flat) return zp_opening(&model->topology, v);
  return zp_parting(&model->topology, v, zp_widest_station(model, y));
}

/* Along a pouch, and of a ribbon without electrodes, the load tells how far the ends are apart. */
static inline bool zp_spreads_by_load(const ZpModel *model) {
  return model->topology.along || !model->field;
}

/* How far its ends, or its faces, are apart, m: how far the load hangs, where it tells; the opening of a pair; under a
 * counter electrode the last gap. (changes of all nodes) => its own. */
static inline double zp_spread(const ZpModel *model, ZpNodes nodes) {
  return zp_spreads_by_load(model) ? zp_hangs_by(&model->topology, nodes) : zp_last_gap(model, nodes.y);
}

static inline double zp_spread_change(const ZpModel *model, ZpNodes changes) {
  return zp_spreads_by_load(model) ? zp_hangs_by(&model->topology, changes)
                                   : zp_last_gap_rate(model, changes.y, changes.y);
}

/* Faces nearer than this have closed, m: they touch, or their film is thinner than the liquid equivalent to the
 * insulators. */
static inline double zp_closed_film(const ZpModel *model) {
  return model->has_film ? fmax(model->faces.range, model->plates.d) : model->faces.range;
}

/* The gap at which an actuator counts as closed, m: where the front of a pouch has come; of others beyond the stop 1 %
 * of the hanging one, or the depth of contact if that is more. */
static inline double zp_closed_opening(const ZpModel *model, double hanging) {
  const ZpContactParams *faces = &model->faces;
  if (model->topology.along) return zp_closed_film(model);
  return faces->stop + fmax(zp_still_open * (hanging - faces->stop), faces->depth);
}

/* How much of the way from its hanging opening to the stop, or to contact, an actuator has closed; and the change of
 * this with the opening, 1/m. */
static inline double zp_contraction(const ZpModel *model, double opening, double hanging) {
  return 1 - (opening - model->faces.stop) / (hanging - model->faces.stop);
}

static inline double zp_contraction_slope(const ZpModel *model, double hanging) {
  return -1 / (hanging - model->faces.stop);
}

/* (sum of lengths over g + d, 1) => capacitance of the modelled part, F. */
static inline double zp_part_capacitance(const ZpModel *model, double inverse_gap) {
  const ZpActuatorDef *def = &model->def;
  return model->mirror * model->mirror * ZP_EPS0 * def->medium.permittivity * def->ribbon.width * inverse_gap;
}

/* Where study isometric holds the load's end: the opening, or the length of a pouch at its strain, m. */
static inline double zp_held_opening(const ZpModel *model) {
  const ZpActuatorDef *def = &model->def;
  if (model->pouch.w == 0 || zp_is_network(model)) return def->isometric.separation;
  return model->stroke_at / (double)model->in_series - def->isometric.strain * def->ribbon.length;
}

/* Length of faces that face each other in the whole actuator, platform's electrode included, m. */
static inline double zp_contact_length(const ZpModel *model) {
  const ZpTopology *t = &model->topology;
  const double flexible = zp_half_elements(t) > 0 ? model->L : 0,
               length = model->pouch.w > 0 ? model->pouch.electrode : flexible;
  return model->parts * (double)zp_halves(t) * (length + model->plates.flat_length);
}

/* Forces on all nodes: only this room knows where x and y stand. */
typedef struct ZpForces {
  double *x, *y; /* to add to */
} ZpForces;

static inline ZpNodes zp_nodes(const ZpModel *model, const double *q) {
  return (ZpNodes){q, q + model->stride};
}

/* Of all nodes: x (0), y (1), in space also z (2) and the angle of the edge to the right (3). */
static inline double *zp_axis(const ZpModel *model, double *q, size_t axis) {
  return q + axis * model->stride;
}

/* For reading. */
static inline const double *zp_read_axis(const ZpModel *model, const double *q, size_t axis) {
  return q + axis * model->stride;
}

static inline ZpForces zp_forces(const ZpModel *model, double *F) {
  return (ZpForces){F, F + model->stride};
}

/* Coordinate k of q; of k = 0 and 1 x and y of all nodes. */
static inline double *zp_coordinate(const ZpModel *model, double *q, size_t k) {
  return q + zp_place_of(k, model->count, model->stride);
}

/* [stride] of q those along which the load pulls. */
static inline double *zp_pulled_of(const ZpModel *model, double *q) {
  return zp_coordinate(model, q, zp_pulled(&model->topology, 0));
}

/* How many numbers x has, whole lanes. */
static inline size_t zp_lanes(const ZpModel *model) {
  return model->stride;
}

/* How many numbers a solver predicts for the stiffness: tensions of edges, in space behind them moments of joints about
 * the normal. */
static inline size_t zp_predicted(const ZpModel *model) {
  return (zp_is_in_space(model) ? 2 : 1) * zp_lanes(model);
}

/* A state by axis, for reading. */
typedef struct ZpMotion {
  const double *x, *y, *vx, *vy; /* [stride] */
} ZpMotion;

static inline ZpMotion zp_state_motion(const ZpModel *model, const ZpState *state) {
  const double *q = state->data, *v = q + zp_coordinates(model);
  return (ZpMotion){q, q + model->stride, v, v + model->stride};
}

/* The force that is held between refreshes, of all coordinates: N, or of a solved field N/V^2 beyond plates. */
static inline double *zp_state_held(const ZpModel *model, ZpState *state) {
  return state->data + 2 * zp_coordinates(model);
}

/* The coordinates at which it was found. */
static inline double *zp_state_held_at(const ZpModel *model, ZpState *state) {
  return state->data + 3 * zp_coordinates(model);
}

/* For reading. */
static inline const double *zp_held_force(const ZpModel *model, const ZpState *state) {
  return state->data + 2 * zp_coordinates(model);
}

/* Of all stations. */
static inline size_t zp_extra_unknowns(const ZpModel *model) {
  return model->own * model->nodes;
}

/* Unknowns of the laws, [own N] station by station. */
static inline double *zp_state_own(const ZpModel *model, ZpState *state) {
  return state->data + 6 * zp_coordinates(model);
}

/* State of the laws, [kept], law by law. */
static inline const double *zp_state_memory(const ZpModel *model, const ZpState *state) {
  return state->data + 6 * zp_coordinates(model) + zp_extra_unknowns(model);
}

/* The law of a term in a model; NULL: it has none. */
static inline const ZpLaw *zp_law(const ZpModel *model, const struct ZpTerm *term) {
  for (const ZpLaw *law = model->law; law < model->law + model->laws; law++)
    if (law->term == term) return law;
  return NULL;
}

/* The numbers of one law in a state of all laws [kept]; NULL of a law without any. */
static inline const double *zp_law_memory(const ZpModel *model, const struct ZpTerm *term, const double *memory) {
  const ZpLaw *law = zp_law(model, term);
  return memory && law && law->state > 0 ? memory + law->at : NULL;
}

static inline double *zp_law_state(const ZpModel *model, const struct ZpTerm *term, ZpState *state) {
  const ZpLaw *law = zp_law(model, term);
  return law && law->state > 0 ? zp_state_own(model, state) + zp_extra_unknowns(model) + law->at : NULL;
}

/* The ledger, [rows]: what rows of losses have lost since it was opened, and what rows of energies held then, J. */
static inline double *zp_state_ledger(const ZpModel *model, ZpState *state) {
  return state->data + 6 * zp_coordinates(model) + zp_extra_unknowns(model) + model->kept;
}

/* Of a network, in the state of its first member: forces and torques that a program sets on bodies, [bodies][3]. */
enum { ZP_PUSHES = 3 };
#define ZP_RAMP_NUMBERS (sizeof(ZpRamp) / sizeof(double))
static inline size_t zp_state_pushes_size(const ZpModel *model) {
  return model->number == 0 && zp_is_network(model) ? ZP_PUSHES * ZP_RAMP_NUMBERS * model->network->bodies : 0;
}

/* Bodies in the plane, there, too: their unknowns, the velocities of these, and mean velocity and mean acceleration
 * over the last step, each [unknowns], and the strains of springs with friction [springs]; how many numbers these
 * are. */
static inline size_t zp_state_bodies_size(const ZpModel *model) {
  const ZpNetwork *network = model->network;
  return model->number == 0 ? 4 * network->unknowns + (network->plane ? network->springs : 0) : 0;
}

static inline double *zp_state_bodies(const ZpModel *model, ZpState *state) {
  return zp_state_ledger(model, state) + model->ledger.rows;
}

/* How far the faces of each spring that rubs have shifted without sliding, m; 0 of others. */
static inline double *zp_state_strains(const ZpModel *first, ZpState *state) {
  return zp_state_bodies(first, state) + 4 * first->network->unknowns;
}

static inline ZpRamp *zp_state_push(const ZpModel *first, ZpState *state, size_t body, size_t way) {
  double *from = zp_state_bodies(first, state) + zp_state_bodies_size(first);
  return (ZpRamp *)(void *)(from + ZP_RAMP_NUMBERS * (ZP_PUSHES * body + way));
}

/* For reading. */
static inline ZpRamp zp_state_pushed(const ZpModel *first, const ZpState *state, size_t body, size_t way) {
  const double *from = state->data + (zp_state_size(first) - offsetof(ZpState, data)) / sizeof(double) -
                       zp_state_pushes_size(first) + ZP_RAMP_NUMBERS * (ZP_PUSHES * body + way);
  return (ZpRamp){from[0], from[1], from[2], from[3]};
}

/* The number of a row; that of all rows if it is none of them. */
static inline size_t zp_row_number(const ZpLedger *ledger, const ZpRow *row) {
  size_t k = 0;
  while (k < ledger->rows && ledger->row[k] != row)
    k++;
  return k;
}

/* The entry of a row, which the model must have, in a ledger [rows]. */
static inline double *zp_ledger_at(const ZpModel *model, double *ledger, const ZpRow *row) {
  return ledger + zp_row_number(&model->ledger, row);
}

static inline double *zp_state_row(const ZpModel *model, ZpState *state, const ZpRow *row) {
  return zp_ledger_at(model, zp_state_ledger(model, state), row);
}

/* Mean velocity and mean acceleration over the last implicit step. */
static inline double *zp_state_mean_v(const ZpModel *model, ZpState *state) {
  return state->data + 4 * zp_coordinates(model);
}

static inline double *zp_state_mean_a(const ZpModel *model, ZpState *state) {
  return state->data + 5 * zp_coordinates(model);
}

/* As zp_model_create_driven, but without laws. */
ZpStatus zp_model_build(const ZpActuatorDef *def, const ZpDriveTable *table, ZpModel **out, ZpError *err);

/* As zp_model_create_on_mesh, but without laws. */
ZpStatus zp_model_build_on_mesh(const ZpModel *model, int nodes, ZpModel **out, ZpError *err);

#endif
