/* Every key of keys.def acts: in a scene where it is in use another value changes the output that it should, by what
 * a closed form or a law of scaling says, else by far more than rounding; and leaves alone what it should. A new key
 * without a row here fails. */
#include "data_util.h"

#include <sys/stat.h>
#include <unistd.h>

#include <zipact/calibrate.h>
#include <zipact/campaign.h>
#include <zipact/io.h>

#include "campaign/case_hash.h"

/* -- scenes ---------------------------------------------------------------------------------------- */

/* A weightless strip 0.1 m long, clamped at the left, under 10 mg at its guided end: it bends by 0.3 mm, linearly. */
#define STRIP                                                                                                          \
  "study=stationary actuator.kind=ribbon actuator.right_end=guided ribbon.density=0 load.mass=10mg mesh.nodes=21"
#define SAGS                                                                                                           \
  "study=stationary actuator.kind=ribbon actuator.right_end=free load.mass=0 gravity=0.001 ribbon.length=50mm "        \
  "mesh.nodes=21"
#define YIELDS "study=stationary actuator.kind=ribbon actuator.right_end=free ribbon.density=0 mesh.nodes=81"
#define CANTILEVER                                                                                                     \
  "study=stationary actuator.kind=ribbon actuator.right_end=free ribbon.density=0 load.mass=2mg mesh.nodes=21"

/* Two weightless strips, 45 mm flexible, that part by 0.2 mm. */
#define PAIR "study=stationary ribbon.density=0 load.mass=0.1g mesh.nodes=21 drive.voltage=1V"

/* Two weightless strips, 45 mm flexible, that hardly part: by a load, by nothing, by their own weight. */
#define SLIGHT "study=stationary ribbon.density=0 load.mass=0.1mg mesh.nodes=21 drive.voltage=0"
#define FLAT   "study=stationary gravity=0 load.mass=0 mesh.nodes=21 drive.voltage=0"
#define SAGGED "study=stationary ribbon.density=0 gravity=0.001 load.mass=0 mesh.nodes=21 drive.voltage=0"

/* A platform that may turn. */
#define TURNING " actuator.symmetry=none platform.electrode=false liquid.model=none"

/* Eight actuators in series. */
#define EIGHT        SLIGHT " stack.series=8"
#define EIGHT_CLOSED UNCAPPED " stack.series=8"

/* Two at one load in the middle, looked at before anything moves. */
#define OPPOSED                                                                                                        \
  "study=actuate gravity=0 stack.series=2 stack.distance=10mm mesh.nodes=21 drive.voltage=2kV solver.end_time=1ns "    \
  "liquid.model=none"

/* Frequencies of a strip in no gravity. */
#define TUNED                                                                                                          \
  "study=modes actuator.kind=ribbon actuator.right_end=guided gravity=0 load.mass=0 ribbon.length=20mm mesh.nodes=21"

/* Closed all along, the platform too, looked at before anything moves: a plane capacitor of two insulators. */
#define CLOSED   "study=actuate initial.state=straight mesh.nodes=5 solver.end_time=1ns"
#define UNCAPPED CLOSED " drive.voltage=1kV electro.breakdown_cap=false"

/* One ribbon, 20 mm long, below a flat electrode. */
#define FLANGE "actuator.kind=flange actuator.right_end=guided load.mass=0 ribbon.length=20mm mesh.nodes=21"

/* A plate on a hinge. */
#define FOLD                                                                                                           \
  "study=stationary actuator.kind=hinge ribbon.length=20mm ribbon.thickness=5mm ribbon.young_modulus=1000GPa "         \
  "load.mass=0 mesh.nodes=11"

/* What the source does is looked at; nothing much moves. */
#define DRIVEN "study=actuate initial.state=straight mesh.nodes=5 drive.voltage=2kV"

/* A closed actuator without weight, a capacitor of 199.8 pF, behind an amplifier. */
#define FED                                                                                                            \
  "study=actuate initial.state=straight mesh.nodes=11 gravity=0 load.mass=0 electro.breakdown_cap=false "              \
  "drive.voltage=50V solver.tolerance=1e-6 source.model=amplifier solver.end_time=1ms"

/* The same at a constant voltage, for a time that is short for what leaks. */
#define LEAKING                                                                                                        \
  "study=actuate initial.state=straight mesh.nodes=11 gravity=0 load.mass=0 electro.breakdown_cap=false "              \
  "drive.voltage=50V solver.end_time=50ms"

/* The same with a meter of its capacitance. */
#define METERED LEAKING " solver.end_time=2s sense.frequency=1kHz sense.amplitude=50V sense.sampling_rate=16kHz"

/* The same under a controller of its capacitance, 199.8 pF, which stays: samples at 0, 1 ms ... 9 ms. */
#define STEERED                                                                                                        \
  "study=actuate liquid.model=none initial.state=straight mesh.nodes=11 gravity=0 load.mass=0 "                        \
  "electro.breakdown_cap=false drive.voltage=50V solver.end_time=9.9ms control.signal=capacitance "                    \
  "setpoint.value=300pF"
#define HELD_BY_PI STEERED " control.kind=pi"
#define WAVING                                                                                                         \
  "study=actuate liquid.model=none initial.state=straight mesh.nodes=11 gravity=0 load.mass=0 "                        \
  "electro.breakdown_cap=false drive.voltage=50V solver.end_time=9.9ms control.signal=capacitance control.kind=pi "    \
  "control.proportional=0.1V/pF"

/* The default actuator from hanging, on a coarse mesh. */
#define HANGING "study=actuate mesh.nodes=11"

/* Something falls on its platform, which hangs. */
#define FALLS HANGING " drive.voltage=0 liquid.model=none load.change_time=1us solver.end_time=2us"

/* The same in a bath, and in one so viscous that nothing else counts. */
#define BATH "study=actuate mesh.nodes=11 liquid.model=submerged solver.end_time=20s solver.stop_when_zipped=true"

/* The default actuator with a bead at its fronts; faces pressed flat on a drop of it, and parted by it. */
#define BEAD                                                                                                           \
  "study=actuate mesh.nodes=11 liquid.model=bead bead.volume=50uL solver.end_time=0.5s solver.stop_when_zipped=true"
#define DROP      "study=actuate mesh.nodes=11 liquid.model=bead bead.volume=1uL solver.end_time=1ns"
#define CAPILLARY DROP
#define VISCOUS   BATH " medium.kinematic_viscosity=1000mm2/s liquid.inertia=false medium.drag_coefficient=0"

/* The paper's particles, zipping one after the other. */
#define PARTICLES                                                                                                      \
  "study=actuate mesh.nodes=11 ribbon.model=mass_spring mass_spring.axial=code solver.integrator=explicit "            \
  "contact.model=sequential"
#define BEZIER PARTICLES " electro.surface=bezier"

/* A limp strand released from straight falls freely. */
#define STRAND                                                                                                         \
  "study=actuate actuator.kind=ribbon actuator.right_end=free initial.state=straight ribbon.length=45mm load.mass=0 "  \
  "mesh.nodes=21 ribbon.model=mass_spring mass_spring.shear_coefficient=0 mass_spring.axial=code "                     \
  "solver.integrator=explicit solver.end_time=5ms"

/* A strip released from straight swings in its first mode, mostly. */
#define SWING                                                                                                          \
  "study=actuate actuator.kind=ribbon actuator.right_end=guided initial.state=straight ribbon.length=45mm "            \
  "load.mass=0 mesh.nodes=11 solver.end_time=40ms"

#define HELD    "study=isometric isometric.separation=2mm load.mass=0 mesh.nodes=21 drive.voltage=1V"
#define PROFILE "study=profile profile.shape=cubic isometric.separation=1mm mesh.nodes=21 electro.breakdown_cap=false"

/* Strokes of the strip that hold for 100 GPa are fitted. */
#define FITTED                                                                                                         \
  "study=calibrate actuator.kind=ribbon actuator.right_end=guided ribbon.density=0 mesh.nodes=21 data.file=soft.csv "  \
  "calibrate.fit=ribbon.young_modulus"

/* -- what they lead to ----------------------------------------------------------------------------- */

typedef enum Change {
  TIMES,   /* the output is `expected` times that before, within `tolerance` */
  PLUS,    /* it is `expected` more, within `tolerance` of that */
  BECOMES, /* it is `expected` */
  MORE,    /* it is more than `expected` times that before */
  LESS,    /* less than `expected` times that before */
  SAME     /* but for rounding */
} Change;

typedef struct Effect {
  Change change;
  const char *output;
  double expected, tolerance;
} Effect;

enum { EFFECTS = 3 };

typedef struct Row {
  const char *key, *scene; /* the key, and what else is set */
  const char *from, *to;   /* its value before and after */
  Effect effect[EFFECTS];
} Row;

#define NU2             (0.285 * 0.285)            /* of the default steel */
#define PLATES          (2 * 130e-6 * 2.75 / 4.62) /* d: liquid that stands for both insulators, m */
#define CLOSED_AT_10_KV (10e3 / 20e6)              /* g + d at which breakdown sets in, m */
#define LINE_MASS       (7850 * 12.7e-3 * 50e-6)   /* kg/m */
#define CUBE(x)         ((x) * (x) * (x))
#define EI              (200e9 * 12.7e-3 * CUBE(50e-6) / 12 / (1 - NU2))
#define SQUARE(x)       ((x) * (x))

/* A guided strip of length 1 whose piece from a to b is eight times as stiff: how far it gives way over how far an even
 * one does, by c, cx and cxx, the moments of its compliance. */
#define STIFFER(a, b)                                                                                                  \
  (12 * ((1 - 0.875 * (CUBE(b) - CUBE(a))) / 3 -                                                                       \
         SQUARE((1 - 0.875 * (SQUARE(b) - SQUARE(a))) / 2) / (1 - 0.875 * ((b) - (a)))))

/* A guided strip of 45 mm bowed by 0.002 per metre from a to b rises by this. */
#define RISES(a, b) (0.001 * ((b) - (a)) * (45e-3 - (a) - (b)))

/* Of FLANGE, 1 mm and 100 um of insulators below the electrode, at 500 V: what omega^2 loses over 4 pi^2, and its
 * first two frequencies, Hz (roots 2.36502 and 5.49780 of a clamped, guided strip). */
#define SOFTENING   (8.8541878e-12 * 2.75 * 12.7e-3 * SQUARE(500) / CUBE(1.1e-3) / LINE_MASS / SQUARE(2 * 3.14159265))
#define FIRST_MODE  (169.15)
#define SECOND_MODE (914.10)

static const Row rows[] = {
    {"study", HANGING " drive.voltage=3kV", "stationary", "equilibrium", {{MORE, "rows", 1.5, 0}}},
    {"preset", "study=stationary", "none", "paper-fe", {{BECOMES, "stroke_m", 2.592e-3, 2e-3}}},
    /* 45 mm of each strip of the pair under half the load, against 100 mm */
    {"actuator.kind",
     "study=stationary ribbon.density=0 load.mass=10mg load.share=0.5 mesh.nodes=21 drive.voltage=1V",
     "electro_ribbon",
     "ribbon",
     {{TIMES, "stroke_m", CUBE(100.0 / 45), 1e-3}}},
    {"actuator.right_end", STRIP, "guided", "free", {{TIMES, "y_m", 4, 5e-4}}},
    /* the second mode leaves the platform where it is, and one half rises as the other sinks */
    {"actuator.symmetry",
     "study=modes mesh.nodes=11",
     "half",
     "none",
     {{SAME, "frequency_1_Hz", 0, 1e-7}, {LESS, "frequency_2_Hz", 0.995, 0}}},
    /* eqs. (19.5) and (19.6) with a = 10 mm, L = 45 mm */
    {"actuator.held_clip",
     SLIGHT TURNING " platform.rotates=true",
     "none",
     "left",
     {{TIMES, "opening_m", 12 * 17662.5 / 290700, 3e-3}}},
    {"ribbon.material",
     STRIP,
     "none",
     "copper",
     {{TIMES, "y_m", (200e9 / 120e9) * (1 - 0.34 * 0.34) / (1 - NU2), 1e-4}}},
    {"ribbon.length", STRIP, "0.1m", "0.05m", {{TIMES, "y_m", 1.0 / 8, 1e-4}}},
    {"ribbon.width", STRIP, "10mm", "20mm", {{TIMES, "y_m", 0.5, 1e-4}}},
    {"ribbon.thickness", STRIP, "50um", "100um", {{TIMES, "y_m", 1.0 / 8, 1e-4}}},
    {"ribbon.young_modulus", STRIP, "100GPa", "200GPa", {{TIMES, "y_m", 0.5, 1e-4}}},
    {"ribbon.yield_stress", STRIP, "500MPa", "1GPa", {{TIMES, "yield_margin", 2, 1e-12}, {SAME, "y_m", 0, 1e-12}}},
    /* 1.45 times the load at which the clamp yields: a cantilever of a metal that does not harden */
    {"ribbon.plasticity",
     YIELDS " ribbon.yield_stress=1MPa load.mass=7.8216mg",
     "false",
     "true",
     {{TIMES, "y_m", (5 - (3 + 1.45) * 0.31622777) / (1.45 * 1.45) / 1.45, 5e-3}}},
    /* 20 times that load; sums of the curvatures of (2.11), which bear its moments */
    {"ribbon.hardening_modulus",
     YIELDS " ribbon.plasticity=true ribbon.yield_stress=1MPa ribbon.length=10mm load.mass=1.078831g",
     "200GPa",
     "600GPa",
     {{TIMES, "y_m", 0.672389, 2e-3}}},
    {"ribbon.poisson_ratio", STRIP, "0", "0.4", {{TIMES, "y_m", 1 - 0.16, 1e-4}}},
    {"ribbon.poisson_ratio", STRIP " ribbon.plane=stress", "0", "0.4", {{SAME, "y_m", 0, 0}}},
    {"ribbon.density",
     TUNED,
     "2000kg/m3",
     "8000kg/m3",
     {{TIMES, "frequency_1_Hz", 0.5, 1e-6}, {TIMES, "frequency_5_Hz", 0.5, 1e-6}}},
    {"ribbon.plane", STRIP, "stress", "strain", {{TIMES, "y_m", 1 - NU2, 1e-4}}},
    /* deflections of the discrete cantilevers: sums of squared moments over the joints */
    {"ribbon.plane", STRIP, "anticlastic", "stress", {{TIMES, "y_m", 1, 2e-3}}},
    {"ribbon.model", CANTILEVER, "rod", "mass_spring", {{TIMES, "y_m", 41.0 / 44, 2e-4}}},

    /* 40 mm at the clamp are twice as thick; the compliances add */
    {"segment_1.length",
     CANTILEVER " segment_1.thickness=100um",
     "0",
     "40mm",
     {{TIMES, "y_m", (1 - CUBE(0.6)) / 8 + CUBE(0.6), 4e-3}}},
    {"segment_1.thickness",
     CANTILEVER " segment_1.length=40mm",
     "50um",
     "100um",
     {{TIMES, "y_m", (1 - CUBE(0.6)) / 8 + CUBE(0.6), 4e-3}}},
    /* a bow of the piece from a to b lifts the end by k ((L - a)^2 - (L - b)^2) / 2; at a clamp k l^2 / 12 less, (8.9)
     */
    {"segment_1.curvature",
     CANTILEVER " segment_1.length=20mm",
     "0",
     "0.1",
     {{PLUS, "y_m", 0.1 * ((SQUARE(0.1) - SQUARE(0.08)) / 2 - SQUARE(5e-3) / 12), 1e-3}}},
    {"segment_2.length",
     CANTILEVER " segment_1.length=20mm segment_2.thickness=100um",
     "0",
     "30mm",
     {{TIMES, "y_m", 1 - (CUBE(0.8) - CUBE(0.5)) * 7 / 8, 4e-3}}},
    {"segment_2.thickness",
     CANTILEVER " segment_1.length=20mm segment_2.length=30mm",
     "50um",
     "100um",
     {{TIMES, "y_m", 1 - (CUBE(0.8) - CUBE(0.5)) * 7 / 8, 4e-3}}},
    {"segment_2.curvature",
     CANTILEVER " segment_1.length=20mm segment_2.length=30mm",
     "0",
     "0.1",
     {{PLUS, "y_m", 0.1 * (SQUARE(0.08) - SQUARE(0.05)) / 2, 1e-3}}},
    {"segment_3.length",
     CANTILEVER " segment_1.length=20mm segment_2.length=30mm segment_3.thickness=25um",
     "0",
     "40mm",
     {{TIMES, "y_m", 1 + (CUBE(0.5) - CUBE(0.1)) * 7, 4e-3}}},
    {"segment_3.thickness",
     CANTILEVER " segment_1.length=20mm segment_2.length=30mm segment_3.length=40mm",
     "50um",
     "25um",
     {{TIMES, "y_m", 1 + (CUBE(0.5) - CUBE(0.1)) * 7, 4e-3}}},
    {"segment_3.curvature",
     CANTILEVER " segment_1.length=20mm segment_2.length=30mm segment_3.length=40mm",
     "0",
     "0.1",
     {{PLUS, "y_m", 0.1 * (SQUARE(0.05) - SQUARE(0.01)) / 2, 1e-3}}},

    {"platform.length", PAIR, "10mm", "20mm", {{TIMES, "opening_m", CUBE(40.0 / 45), 1e-3}}},
    {"platform.electrode",
     UNCAPPED,
     "true",
     "false",
     {{TIMES, "capacitance_F", 0.9, 1e-6}, {TIMES, "force_N", 0.9, 1e-6}, {TIMES, "charge_C", 0.9, 1e-6}}},

    /* the lowest mode that tilts the platform, some 10 Hz, is gone where a guide holds it */
    {"platform.rotates", "study=modes mesh.nodes=21" TURNING, "false", "true", {{LESS, "frequency_2_Hz", 0.2, 0}}},

    {"insulator.thickness",
     UNCAPPED,
     "100um",
     "200um",
     {{TIMES, "capacitance_F", 0.5, 1e-6}, {TIMES, "force_N", 0.25, 1e-6}}},
    {"insulator.material", UNCAPPED, "none", "kapton", {{TIMES, "capacitance_F", 3.4 / 4.62, 1e-6}}},
    {"insulator.permittivity", UNCAPPED, "3", "6", {{TIMES, "capacitance_F", 2, 1e-6}, {TIMES, "force_N", 4, 1e-6}}},
    {"insulator.density",
     TUNED " insulator.thickness=100um",
     "0",
     "3925kg/m3",
     {{TIMES, "frequency_1_Hz", 0.70710678, 1e-6}}},
    /* two layers as thick, as stiff and without lateral strain: the neutral axis lies between them, E I is eightfold */
    {"insulator.young_modulus",
     STRIP " ribbon.poisson_ratio=0 insulator.thickness=50um ribbon.young_modulus=100GPa",
     "0",
     "100GPa",
     {{TIMES, "y_m", 1.0 / 8, 1e-4}}},
    {"insulator.breakdown_field",
     CLOSED,
     "100MV/m",
     "10MV/m",
     {{MORE, "notes", 0, 0}, {TIMES, "breakdown_margin", 0.1, 1e-12}, {SAME, "force_N", 0, 1e-12}}},
    /* of two strips in series the lower one is half of what gives way */
    {"lower.ribbon.material",
     SLIGHT " lower.ribbon.density=0",
     "none",
     "copper",
     {{TIMES, "opening_m", (1 + (200e9 / 120e9) * (1 - 0.34 * 0.34) / (1 - NU2)) / 2, 1e-4}}},
    {"lower.ribbon.thickness", SLIGHT, "50um", "100um", {{TIMES, "opening_m", (1 + 1.0 / 8) / 2, 1e-4}}},
    {"lower.ribbon.young_modulus", SLIGHT, "200GPa", "100GPa", {{TIMES, "opening_m", 1.5, 1e-4}}},
    {"lower.ribbon.poisson_ratio",
     SLIGHT " ribbon.poisson_ratio=0",
     "0",
     "0.4",
     {{TIMES, "opening_m", (1 + 1 - 0.16) / 2, 1e-4}}},
    {"lower.ribbon.density", SAGGED, "2000kg/m3", "4000kg/m3", {{TIMES, "opening_m", 2, 1e-4}}},
    /* two cantilevers back to back in each strip, which sink far less than they are thick: half of the sum of both */
    {"lower.ribbon.hardening_modulus",
     "study=stationary ribbon.density=0 ribbon.length=12.5mm load.mass=34.5227g mesh.nodes=81 drive.voltage=0 "
     "ribbon.plasticity=true ribbon.yield_stress=1MPa ribbon.hardening_modulus=200GPa",
     "200GPa",
     "600GPa",
     {{TIMES, "opening_m", 0.836194, 2e-3}}},
    {"lower.ribbon.yield_stress",
     SLIGHT,
     "100MPa",
     "200MPa",
     {{TIMES, "yield_margin", 2, 1e-12}, {SAME, "opening_m", 0, 1e-12}}},
    {"lower.segment_1.length",
     FLAT " lower.segment_1.curvature=0.002",
     "0",
     "9mm",
     {{PLUS, "opening_m", RISES(0, 9e-3) - 0.002 * SQUARE(2.25e-3) / 12, 1e-3}}},
    {"lower.segment_1.thickness",
     SLIGHT " segment_1.length=9mm",
     "50um",
     "100um",
     {{TIMES, "opening_m", (1 + STIFFER(0, 0.2)) / 2, 4e-3}}},
    {"lower.segment_1.curvature",
     FLAT " segment_1.length=9mm",
     "0",
     "0.002",
     {{PLUS, "opening_m", RISES(0, 9e-3) - 0.002 * SQUARE(2.25e-3) / 12, 1e-3}}},
    {"lower.segment_2.length",
     SLIGHT " segment_1.length=4.5mm lower.segment_2.curvature=0.002",
     "0",
     "4.5mm",
     {{PLUS, "opening_m", RISES(4.5e-3, 9e-3), 1e-3}}},
    {"lower.segment_2.thickness",
     SLIGHT " segment_1.length=4.5mm segment_2.length=9mm",
     "50um",
     "100um",
     {{TIMES, "opening_m", (1 + STIFFER(0.1, 0.3)) / 2, 4e-3}}},
    {"lower.segment_2.curvature",
     SLIGHT " segment_1.length=4.5mm segment_2.length=4.5mm",
     "0",
     "0.002",
     {{PLUS, "opening_m", RISES(4.5e-3, 9e-3), 1e-3}}},
    {"lower.segment_3.length",
     SLIGHT " segment_1.length=4.5mm lower.segment_3.curvature=0.002",
     "0",
     "4.5mm",
     {{PLUS, "opening_m", RISES(4.5e-3, 9e-3), 1e-3}}},
    {"lower.segment_3.thickness",
     SLIGHT " segment_1.length=4.5mm segment_3.length=9mm",
     "50um",
     "100um",
     {{TIMES, "opening_m", (1 + STIFFER(0.1, 0.3)) / 2, 4e-3}}},
    {"lower.segment_3.curvature",
     SLIGHT " segment_1.length=4.5mm segment_3.length=4.5mm",
     "0",
     "0.002",
     {{PLUS, "opening_m", RISES(4.5e-3, 9e-3), 1e-3}}},
    {"lower.insulator.material", UNCAPPED, "none", "kapton", {{TIMES, "capacitance_F", 2 / (1 + 4.62 / 3.4), 1e-6}}},
    {"lower.insulator.thickness",
     UNCAPPED,
     "130um",
     "260um",
     {{TIMES, "capacitance_F", 1 / 1.5, 1e-6}, {TIMES, "force_N", 1 / SQUARE(1.5), 1e-6}}},
    {"lower.insulator.permittivity", UNCAPPED, "4.62", "2.31", {{TIMES, "capacitance_F", 1 / 1.5, 1e-6}}},
    {"lower.insulator.density", SAGGED, "1000kg/m3", "2000kg/m3", {{TIMES, "opening_m", 2, 1e-4}}},
    {"lower.insulator.young_modulus",
     SLIGHT " ribbon.poisson_ratio=0 insulator.thickness=50um ribbon.young_modulus=100GPa",
     "0",
     "100GPa",
     {{TIMES, "opening_m", (1 + 1.0 / 8) / 2, 1e-4}}},
    {"lower.insulator.breakdown_field",
     CLOSED,
     "40MV/m",
     "10MV/m",
     {{TIMES, "breakdown_margin", 0.25, 1e-12}, {SAME, "capacitance_F", 0, 1e-12}}},
    /* closed faces have no liquid between them: only the force on it, eps E^2 / 2, knows that it is there */
    {"medium.material", UNCAPPED, "none", "mineral_oil", {{TIMES, "force_N", 2.75 / 2.2, 1e-6}}},
    {"medium.permittivity", UNCAPPED, "2", "4", {{TIMES, "force_N", 0.5, 1e-6}, {SAME, "capacitance_F", 0, 1e-8}}},
    {"medium.breakdown_field",
     CLOSED " drive.voltage=10kV electro.breakdown_cap=true",
     "10MV/m",
     "20MV/m",
     {{TIMES, "force_N", 4, 1e-6}, {TIMES, "charge_C", 2, 1e-6}, {SAME, "capacitance_F", 0, 1e-8}}},

    {"insulator.resistivity", LEAKING, "1e12", "2e12", {{TIMES, "leak_loss_J", 0.5, 1e-4}}},
    {"medium.resistivity", LEAKING, "1e12", "2e12", {{TIMES, "interface_voltage_V", 0.5, 2e-3}}},
    {"medium.kinematic_viscosity", VISCOUS, "1000mm2/s", "2000mm2/s", {{TIMES, "zip_time_s", 2, 1e-2}}},
    {"medium.density", VISCOUS, "500kg/m3", "1000kg/m3", {{TIMES, "zip_time_s", 2, 1e-2}}},
    {"medium.drag_coefficient",
     BATH,
     "1.5",
     "0",
     {{BECOMES, "outer_drag_loss_J", 0, 0}, {LESS, "zip_time_s", 0.97, 0}}},
    {"medium.surface_tension",
     CAPILLARY " bead.suction=0.1",
     "10mN/m",
     "20mN/m",
     {{TIMES, "liquid_energy_J", 2, 1e-3}}},
    /* the bead of closed faces that hardly have a gap reaches the platform; a drop does not */
    {"air.breakdown_field",
     DROP " drive.voltage=10kV",
     "3MV/m",
     "1MV/m",
     {{LESS, "force_N", 1, 0}, {LESS, "charge_C", 1, 0}}},
    {"bead.volume", DROP, "1uL", "2uL", {{MORE, "wet_length_m", 1.2, 0}}},
    {"bead.suction", BEAD, "0", "1", {{LESS, "zip_time_s", 0.9, 0}, {LESS, "meniscus_loss_J", 0.2, 0}}},
    {"bead.return", BEAD, "1", "0", {{BECOMES, "bead_outside_m3", 0, 0}, {MORE, "bead_lost_m3", 0, 0}}},
    {"liquid.model", BATH, "none", "submerged", {{MORE, "zip_time_s", 2, 0}, {MORE, "viscous_loss_J", 0, 0}}},
    {"liquid.lateral_flow",
     BATH,
     "true",
     "false",
     {{BECOMES, "film_across_loss_J", 0, 0}, {BECOMES, "jet_loss_J", 0, 0}, {MORE, "zip_time_s", 1.05, 0}}},
    {"liquid.inertia", BATH, "true", "false", {{BECOMES, "jet_loss_J", 0, 0}, {LESS, "zip_time_s", 0.9, 0}}},
    /* closed from the start: what lies between faces that do not touch yet */
    {"film.roughness", CLOSED " liquid.model=submerged", "1um", "2um", {{TIMES, "film_thickness_m", 2, 1e-3}}},

    {"load.mass", STRIP, "10mg", "5mg", {{TIMES, "y_m", 0.5, 1e-4}}},
    /* a spring that hardly gives way is a force */
    {"load.stiffness", SLIGHT " load.mass=0 load.rest_opening=10m", "1e-6", "2e-6", {{TIMES, "opening_m", 2, 1e-4}}},
    {"load.rest_opening", SLIGHT " load.mass=0 load.stiffness=1e-6", "5m", "10m", {{TIMES, "opening_m", 2, 1e-4}}},
    {"load.force", STRIP, "0", "98.1uN", {{TIMES, "y_m", 2, 1e-3}}},
    {"load.stop_opening", "study=stationary mesh.nodes=21", "none", "5mm", {{BECOMES, "opening_m", 5e-3, 2e-3}}},
    {"load.stop_stiffness", SLIGHT " load.stop_opening=0", "1e4", "2e4", {{TIMES, "opening_m", 0.5, 2e-3}}},
    {"stack.series", PAIR, "1", "2", {{TIMES, "opening_m", 2, 1e-9}}},
    {"stack.parallel", SLIGHT, "1", "2", {{TIMES, "opening_m", 0.5, 1e-4}}},
    {"stack.link_mass", SLIGHT " stack.series=2", "0", "0.1mg", {{TIMES, "opening_m", 1.5, 1e-4}}},
    /* without weight both open alike; the half voltage of both is a quarter of the energy */
    {"stack.distance",
     "study=stationary gravity=0 stack.series=2 mesh.nodes=21",
     "10mm",
     "20mm",
     {{TIMES, "opening_m", 2, 1e-9}}},
    {"stack.voltage_ratio", OPPOSED, "0", "1", {{TIMES, "charge_C", 2, 1e-9}}},
    {"stack.lower_voltage", OPPOSED, "2kV", "1kV", {{TIMES, "charge_C", 0.75, 1e-9}}},
    {"member_1.ribbon.thickness", EIGHT, "50um", "100um", {{TIMES, "opening_m", (7 + 1.0 / 8) / 8, 1e-4}}},
    {"member_1.ribbon.young_modulus", EIGHT, "200GPa", "100GPa", {{TIMES, "opening_m", 9.0 / 8, 1e-4}}},
    {"member_1.insulator.thickness", EIGHT_CLOSED, "130um", "65um", {{TIMES, "capacitance_F", 9.0 / 8, 1e-6}}},
    {"member_1.insulator.permittivity", EIGHT_CLOSED, "4.62", "9.24", {{TIMES, "capacitance_F", 9.0 / 8, 1e-6}}},
    {"member_2.ribbon.thickness", EIGHT, "50um", "100um", {{TIMES, "opening_m", (7 + 1.0 / 8) / 8, 1e-4}}},
    {"member_2.ribbon.young_modulus", EIGHT, "200GPa", "100GPa", {{TIMES, "opening_m", 9.0 / 8, 1e-4}}},
    {"member_2.insulator.thickness", EIGHT_CLOSED, "130um", "65um", {{TIMES, "capacitance_F", 9.0 / 8, 1e-6}}},
    {"member_2.insulator.permittivity", EIGHT_CLOSED, "4.62", "9.24", {{TIMES, "capacitance_F", 9.0 / 8, 1e-6}}},
    {"member_3.ribbon.thickness", EIGHT, "50um", "100um", {{TIMES, "opening_m", (7 + 1.0 / 8) / 8, 1e-4}}},
    {"member_3.ribbon.young_modulus", EIGHT, "200GPa", "100GPa", {{TIMES, "opening_m", 9.0 / 8, 1e-4}}},
    {"member_3.insulator.thickness", EIGHT_CLOSED, "130um", "65um", {{TIMES, "capacitance_F", 9.0 / 8, 1e-6}}},
    {"member_3.insulator.permittivity", EIGHT_CLOSED, "4.62", "9.24", {{TIMES, "capacitance_F", 9.0 / 8, 1e-6}}},
    {"member_4.ribbon.thickness", EIGHT, "50um", "100um", {{TIMES, "opening_m", (7 + 1.0 / 8) / 8, 1e-4}}},
    {"member_4.ribbon.young_modulus", EIGHT, "200GPa", "100GPa", {{TIMES, "opening_m", 9.0 / 8, 1e-4}}},
    {"member_4.insulator.thickness", EIGHT_CLOSED, "130um", "65um", {{TIMES, "capacitance_F", 9.0 / 8, 1e-6}}},
    {"member_4.insulator.permittivity", EIGHT_CLOSED, "4.62", "9.24", {{TIMES, "capacitance_F", 9.0 / 8, 1e-6}}},
    {"member_5.ribbon.thickness", EIGHT, "50um", "100um", {{TIMES, "opening_m", (7 + 1.0 / 8) / 8, 1e-4}}},
    {"member_5.ribbon.young_modulus", EIGHT, "200GPa", "100GPa", {{TIMES, "opening_m", 9.0 / 8, 1e-4}}},
    {"member_5.insulator.thickness", EIGHT_CLOSED, "130um", "65um", {{TIMES, "capacitance_F", 9.0 / 8, 1e-6}}},
    {"member_5.insulator.permittivity", EIGHT_CLOSED, "4.62", "9.24", {{TIMES, "capacitance_F", 9.0 / 8, 1e-6}}},
    {"member_6.ribbon.thickness", EIGHT, "50um", "100um", {{TIMES, "opening_m", (7 + 1.0 / 8) / 8, 1e-4}}},
    {"member_6.ribbon.young_modulus", EIGHT, "200GPa", "100GPa", {{TIMES, "opening_m", 9.0 / 8, 1e-4}}},
    {"member_6.insulator.thickness", EIGHT_CLOSED, "130um", "65um", {{TIMES, "capacitance_F", 9.0 / 8, 1e-6}}},
    {"member_6.insulator.permittivity", EIGHT_CLOSED, "4.62", "9.24", {{TIMES, "capacitance_F", 9.0 / 8, 1e-6}}},
    {"member_7.ribbon.thickness", EIGHT, "50um", "100um", {{TIMES, "opening_m", (7 + 1.0 / 8) / 8, 1e-4}}},
    {"member_7.ribbon.young_modulus", EIGHT, "200GPa", "100GPa", {{TIMES, "opening_m", 9.0 / 8, 1e-4}}},
    {"member_7.insulator.thickness", EIGHT_CLOSED, "130um", "65um", {{TIMES, "capacitance_F", 9.0 / 8, 1e-6}}},
    {"member_7.insulator.permittivity", EIGHT_CLOSED, "4.62", "9.24", {{TIMES, "capacitance_F", 9.0 / 8, 1e-6}}},
    {"member_8.ribbon.thickness", EIGHT, "50um", "100um", {{TIMES, "opening_m", (7 + 1.0 / 8) / 8, 1e-4}}},
    {"member_8.ribbon.young_modulus", EIGHT, "200GPa", "100GPa", {{TIMES, "opening_m", 9.0 / 8, 1e-4}}},
    {"member_8.insulator.thickness", EIGHT_CLOSED, "130um", "65um", {{TIMES, "capacitance_F", 9.0 / 8, 1e-6}}},
    {"member_8.insulator.permittivity", EIGHT_CLOSED, "4.62", "9.24", {{TIMES, "capacitance_F", 9.0 / 8, 1e-6}}},
    /* what is caught weighs little beside what it falls on: all of its energy is lost */
    {"load.change_mass", FALLS " load.drop_height=10mm", "8mg", "16mg", {{TIMES, "catch_loss_J", 2, 2e-3}}},
    {"load.drop_height", FALLS " load.change_mass=8mg", "10mm", "20mm", {{TIMES, "catch_loss_J", 2, 1e-3}}},
    {"load.change_time",
     FALLS " load.change_mass=8mg load.drop_height=10mm",
     "1us",
     "1ms",
     {{BECOMES, "catch_loss_J", 0, 0}}},
    {"load.offset", SLIGHT TURNING " platform.rotates=true", "1mm", "2mm", {{TIMES, "angle_rad", 2, 1e-4}}},
    {"load.share", PAIR, "0.5", "0.25", {{TIMES, "opening_m", 0.5, 1e-4}}},
    {"gravity", STRIP, "10m/s2", "5m/s2", {{TIMES, "y_m", 0.5, 1e-4}}},
    /* a stiff plate of little weight on a spring: the angle is small */
    {"hinge.stiffness", FOLD, "1", "2", {{TIMES, "stroke_m", 0.5, 1e-3}}},
    {"hinge.rest_angle", FOLD " gravity=0 hinge.stiffness=1", "0.5degree", "1degree", {{TIMES, "angle_rad", 2, 1e-6}}},
    {"mount.tilt", STRIP, "0", "180degree", {{TIMES, "y_m", -1, 1e-9}}},
    /* a discrete cantilever of rods is too soft by 1 / (2 (N - 1)^2) */
    {"mesh.nodes", CANTILEVER, "9", "5", {{TIMES, "y_m", 1, 1e-6}}},

    {"mass_spring.shear_coefficient", STRIP " ribbon.model=mass_spring", "4000", "8000", {{TIMES, "y_m", 0.5, 1e-4}}},
    /* (N - 1)^2 times softer under the same tension */
    {"mass_spring.axial",
     "study=actuate actuator.kind=ribbon ribbon.model=mass_spring mesh.nodes=11 solver.end_time=1ns",
     "text",
     "code",
     {{TIMES, "axial_energy_J", 100, 1e-2}}},

    /* an independent solution of 126 000 unknowns has 1.0008 */
    {"electro.model",
     PROFILE " isometric.separation=17mm",
     "plates",
     "field",
     {{TIMES, "force_N", 1.0008, 5e-4}, {SAME, "plates_force_N", 0, 0}}},
    {"electro.surface", PARTICLES " solver.end_time=5ms", "polyline", "bezier", {{MORE, "kinetic_energy_J", 1.1, 0}}},
    /* C over that of plates, independent study: 1.030 */
    {"electro.edges", UNCAPPED " ribbon.thickness=100um", "false", "true", {{TIMES, "capacitance_F", 1.030, 5e-4}}},
    {"electro.force_scale", UNCAPPED, "1", "3", {{TIMES, "force_N", 3, 1e-6}, {TIMES, "charge_C", 3, 1e-6}}},
    {"electro.voltage_share", UNCAPPED, "1", "0.5", {{TIMES, "force_N", 0.25, 1e-6}}},
    {"electro.voltage_share", CLOSED " drive.voltage=20kV", "1", "0.5", {{SAME, "force_N", 0, 1e-12}}},
    {"electro.force_scale", PROFILE " electro.model=field", "1", "3", {{TIMES, "force_N", 3, 1e-6}}},
    {"electro.voltage_share", PROFILE " electro.model=field", "1", "0.5", {{TIMES, "force_N", 0.25, 1e-6}}},
    {"electro.insulator_offset",
     UNCAPPED,
     "100um",
     "200um",
     {{TIMES, "force_N", 0.25, 1e-6}, {TIMES, "capacitance_F", 0.5, 1e-6}}},
    {"electro.gap_offset",
     "study=actuate initial.state=straight solver.end_time=1ns drive.voltage=100V "
     "electro.insulator_offset=100um " FLANGE,
     "0",
     "100um",
     {{TIMES, "capacitance_F", 0.5, 1e-6}, {TIMES, "force_N", 0.25, 1e-6}}},
    {"electro.breakdown_cap",
     CLOSED " drive.voltage=10kV",
     "true",
     "false",
     {{TIMES, "force_N", SQUARE(CLOSED_AT_10_KV / PLATES), 1e-6}, {SAME, "capacitance_F", 0, 1e-8}}},
    {"electro.switch_offset",
     BEZIER " solver.end_time=5ms electro.breakdown_cap=false",
     "0",
     "300um",
     {{LESS, "kinetic_energy_J", 0.9, 0}}},
    /* further off than U / E_bd it never acts */
    {"electro.switch_offset",
     BEZIER " solver.end_time=5ms electro.breakdown_cap=false",
     "0",
     "501um",
     {{SAME, "kinetic_energy_J", 0, 0}}},
    {"electro.refresh_period", BEZIER " solver.end_time=9ms", "0", "10ms", {{LESS, "kinetic_energy_J", 0.999, 0}}},
    {"electro.refresh_change",
     HANGING " electro.model=field solver.end_time=8ms",
     "0.1",
     "0.5",
     {{MORE, "opening_m", 1.00001, 0}}},

    /* pairs that join and stay need not be pressed down */
    {"contact.model",
     HANGING " solver.integrator=explicit drive.voltage=10kV",
     "unilateral",
     "sequential",
     {{LESS, "zip_time_s", 0.95, 0}}},
    {"contact.complete_margin",
     PARTICLES " electro.breakdown_cap=false drive.voltage=15kV",
     "0",
     "8",
     {{LESS, "zip_time_s", 0.9, 0}}},

    {"drive.voltage",
     UNCAPPED,
     "1kV",
     "2kV",
     {{TIMES, "force_N", 4, 1e-6}, {TIMES, "charge_C", 2, 1e-6}, {SAME, "capacitance_F", 0, 1e-8}}},
    /* a quarter of a cycle after the start the sine is half way up, the square wave on */
    {"drive.waveform",
     DRIVEN " drive.frequency=100Hz solver.end_time=2.5ms",
     "sine",
     "square",
     {{TIMES, "voltage_V", 2, 1e-9}}},
    {"drive.offset",
     DRIVEN " drive.waveform=ramp drive.rise_time=4ms solver.end_time=1ms",
     "0",
     "-1kV",
     {{PLUS, "voltage_V", -750, 1e-9}}},
    {"drive.rise_time",
     DRIVEN " drive.waveform=ramp solver.end_time=1ms",
     "2ms",
     "4ms",
     {{TIMES, "voltage_V", 0.5, 1e-9}}},
    {"drive.rise_time",
     DRIVEN " drive.waveform=square drive.frequency=100Hz solver.end_time=1ms",
     "2ms",
     "4ms",
     {{TIMES, "voltage_V", 0.5, 1e-9}}},
    {"drive.frequency",
     DRIVEN " drive.waveform=sine solver.end_time=2.5ms",
     "100Hz",
     "200Hz",
     {{TIMES, "voltage_V", 2, 1e-9}}},
    {"drive.duty",
     DRIVEN " drive.waveform=square drive.frequency=100Hz drive.offset=1kV solver.end_time=4ms",
     "0.5",
     "0.3",
     {{TIMES, "voltage_V", 0.5, 1e-9}}},
    {"drive.table",
     DRIVEN " drive.waveform=table solver.end_time=1ms",
     "0ms=0kV,2ms=2kV",
     "0ms=0kV,4ms=2kV",
     {{TIMES, "voltage_V", 0.5, 1e-9}}},
    {"drive.file",
     DRIVEN " drive.waveform=table solver.end_time=1ms",
     "fast.csv",
     "slow.csv",
     {{TIMES, "voltage_V", 0.5, 1e-9}}},

    {"source.model",
     HANGING " drive.voltage=10kV liquid.model=none solver.end_time=0.5s",
     "ideal",
     "amplifier",
     {{MORE, "simulated_time_s", 2, 0}, {SAME, "zip_time_s", 0, 0}}},
    {"source.supply", DRIVEN " solver.end_time=0.1ms", "none", "open_5kv", {{TIMES, "voltage_V", 0.75, 1e-9}}},
    {"source.slew_rate", FED, "10V/ms", "20V/ms", {{TIMES, "voltage_V", 2, 1e-9}}},
    {"source.current_limit", FED, "1uA", "2uA", {{TIMES, "voltage_V", 2, 1e-4}}},
    {"source.sink_limit",
     FED " drive.waveform=table drive.table=0ms=50V,1ms=50V,1ms=0V solver.end_time=2ms",
     "1uA",
     "2uA",
     {{PLUS, "voltage_V", -5.005, 1e-3}}},
    /* x = t / (R C) = 0.05005: (1 - exp(-x / 2)) / (1 - exp(-x)) */
    {"source.resistance", FED, "100Mohm", "200Mohm", {{TIMES, "voltage_V", 0.50626, 1e-4}}},
    {"source.capacitance", FED " source.current_limit=1uA", "0", "199.8pF", {{TIMES, "voltage_V", 0.5, 1e-3}}},
    {"source.bleeder",
     FED " source.resistance=100Mohm solver.end_time=1s",
     "none",
     "100Mohm",
     {{TIMES, "voltage_V", 0.5, 1e-6}}},
    /* 1 / (1 + exp(-2 pi 0.05)) */
    {"source.bandwidth", FED, "100Hz", "50Hz", {{TIMES, "voltage_V", 0.57790, 1e-4}}},
    /* windows are of whole periods; white noise leaves its share over the root of the samples */
    {"sense.frequency", METERED " sense.bandwidth=100Hz", "1kHz", "2kHz", {{TIMES, "sense_window_s", 1.125, 1e-12}}},
    {"sense.bandwidth", METERED, "20Hz", "40Hz", {{TIMES, "sense_window_s", 0.5, 1e-12}}},
    {"sense.amplitude", METERED " sense.noise=1nA", "50V", "100V", {{TIMES, "sense_capacitance_error_F", 0.5, 0.02}}},
    {"sense.noise", METERED, "1nA", "2nA", {{TIMES, "sense_capacitance_error_F", 2, 0.02}}},
    {"sense.sampling_rate",
     METERED " sense.noise=1nA",
     "16kHz",
     "64kHz",
     {{TIMES, "sense_capacitance_error_F", 0.5, 0.2}}},
    {"sense.bits", METERED, "8", "16", {{LESS, "sense_capacitance_error_F", 0.1, 0}}},
    {"sense.range", METERED " sense.bits=12", "1mA", "8mA", {{MORE, "sense_capacitance_error_F", 2, 0}}},
    {"sense.seed", METERED " sense.noise=1nA", "1", "2", {{MORE, "sense_capacitance_error_F", 1.001, 0}}},
    /* the capacitance follows the squeeze of the faces, by up to 1e-3 */
    {"control.kind",
     STEERED " control.boost_voltage=10V control.proportional=0.1V/pF",
     "pi",
     "boost_pi",
     {{PLUS, "voltage_V", 10, 1e-4}}},
    {"control.signal",
     HELD_BY_PI " control.proportional=0.1V/pF",
     "capacitance",
     "opening",
     {{LESS, "voltage_V", 0.1, 0}}},
    {"control.proportional", HELD_BY_PI, "0.1V/pF", "0.2V/pF", {{TIMES, "voltage_V", 2, 1e-4}}},
    {"control.integral", HELD_BY_PI, "10V/pF/s", "20V/pF/s", {{TIMES, "voltage_V", 2, 1e-4}}},
    /* 10 samples of 1 ms, 4 of 3 ms */
    {"control.period", HELD_BY_PI " control.integral=10V/pF/s", "1ms", "3ms", {{TIMES, "voltage_V", 1.2, 1e-4}}},
    {"control.delay", HELD_BY_PI " control.integral=10V/pF/s", "0", "2ms", {{TIMES, "voltage_V", 0.8, 1e-4}}},
    {"control.noise", HELD_BY_PI " control.proportional=0.1V/pF", "1e-9pF", "10pF", {{MORE, "measured_F", 1.001, 0}}},
    {"control.seed",
     HELD_BY_PI " control.proportional=0.1V/pF control.noise=10pF",
     "4",
     "1",
     {{MORE, "measured_F", 1.001, 0}}},
    {"control.boost_voltage", STEERED " control.kind=boost_pi", "10V", "20V", {{TIMES, "voltage_V", 2, 1e-4}}},
    {"control.boost_band",
     STEERED " control.kind=boost_pi control.boost_voltage=10V",
     "1",
     "2",
     {{TIMES, "voltage_V", 0.5, 1e-4}}},
    {"setpoint.value", HELD_BY_PI " control.proportional=0.1V/pF", "300pF", "400pF", {{PLUS, "voltage_V", 10, 1e-4}}},
    {"setpoint.waveform",
     WAVING " setpoint.value=300pF setpoint.offset=500pF",
     "sine",
     "square",
     {{LESS, "setpoint_F", 0.7, 0}}},
    {"setpoint.offset",
     WAVING " setpoint.value=500pF setpoint.waveform=ramp setpoint.rise_time=18ms",
     "300pF",
     "200pF",
     {{PLUS, "voltage_V", -5, 1e-4}}},
    {"setpoint.rise_time",
     WAVING " setpoint.value=500pF setpoint.offset=300pF setpoint.waveform=ramp",
     "18ms",
     "36ms",
     {{PLUS, "voltage_V", -5, 1e-4}}},
    {"setpoint.frequency",
     WAVING " setpoint.value=300pF setpoint.offset=500pF setpoint.waveform=square",
     "100Hz",
     "40Hz",
     {{BECOMES, "setpoint_F", 300e-12, 1e-9}}},
    {"setpoint.duty",
     WAVING " setpoint.value=300pF setpoint.offset=500pF setpoint.waveform=square setpoint.frequency=50Hz",
     "0.6",
     "0.4",
     {{BECOMES, "setpoint_F", 500e-12, 1e-9}}},
    {"setpoint.table",
     WAVING " setpoint.waveform=table",
     "0ms=300pF,18ms=500pF",
     "0ms=300pF,36ms=500pF",
     {{PLUS, "voltage_V", -5, 1e-4}}},
    {"setpoint.file",
     WAVING " setpoint.waveform=table",
     "rises.csv",
     "rises_slowly.csv",
     {{PLUS, "voltage_V", -5, 1e-4}}},
    {"cycle.closing_frequency",
     "study=cycle mesh.nodes=7 drive.voltage=8kV drive.waveform=sine drive.frequency=4Hz damping.internal=20ms "
     "cycle.most_cycles=4",
     "false",
     "true",
     {{SAME, "closes", 0, 0}, {BECOMES, "closing_frequency_Hz", 2.48, 0.1}}},
    {"source.voltage_limit",
     FED " source.bandwidth=1kHz",
     "100V",
     "200V",
     {{TIMES, "source_voltage_margin", 2, 1e-12}}},

    /* at v = g t each of the 20 free particles loses c v^3 a second */
    {"damping.drag", STRAND, "0", "1e-5", {{PLUS, "drag_loss_J", 20e-5 * CUBE(9.81) * 625e-12 / 4, 1e-2}}},
    /* auto is 10 us of an electro_ribbon of rods, none of a ribbon */
    {"damping.internal", HANGING " solver.end_time=20ms", "auto", "10us", {{SAME, "internal_loss_J", 0, 0}}},
    {"damping.internal", HANGING " solver.end_time=20ms", "auto", "0", {{LESS, "internal_loss_J", 1e-9, 0}}},
    {"damping.internal", SWING, "auto", "0", {{SAME, "internal_loss_J", 0, 0}}},
    {"damping.internal", SWING, "1us", "2us", {{TIMES, "internal_loss_J", 2, 2e-2}}},

    {"solver.integrator",
     SWING " ribbon.length=0.2m damping.internal=0",
     "explicit",
     "implicit",
     {{LESS, "steps", 0.1, 0}, {TIMES, "stroke_m", 1, 1e-2}}},
    {"solver.end_time", SWING, "2ms", "4ms", {{TIMES, "simulated_time_s", 2, 1e-12}}},
    /* the local error is of third order */
    {"solver.tolerance", SWING, "1e-5", "1e-6", {{TIMES, "steps", 3.16, 0.1}}},
    {"solver.time_step", SWING " solver.end_time=2ms", "20us", "10us", {{TIMES, "steps", 2, 2e-2}}},
    {"solver.stop_when_zipped",
     HANGING " drive.voltage=10kV solver.end_time=0.3s",
     "true",
     "false",
     {{MORE, "simulated_time_s", 2, 0}, {SAME, "zip_time_s", 0, 1e-6}}},
    {"solver.max_steps", SWING, "20", "7", {{BECOMES, "steps", 7, 0}}},

    {"initial.state",
     HANGING " solver.end_time=1ns",
     "equilibrium",
     "straight",
     {{LESS, "opening_m", 1e-6, 0}, {SAME, "frames", 0, 0}}},
    {"initial.file",
     HANGING " initial.state=checkpoint solver.end_time=4ms",
     "early.zps",
     "late.zps",
     {{PLUS, "simulated_time_s", -1e-3, 0.1}}},

    {"data.file", FITTED, "soft.csv", "stiff.csv", {{TIMES, "ribbon.young_modulus", 4, 1e-3}}},
    {"data.columns",
     FITTED,
     "ribbon.width_mm=ribbon.width_mm",
     "ribbon.width_mm=ribbon.length_cm",
     {{TIMES, "ribbon.young_modulus", CUBE(1.27), 1e-3}}},
    {"calibrate.bounds",
     FITTED,
     "ribbon.young_modulus=40GPa..1000GPa",
     "ribbon.young_modulus=160GPa..1000GPa",
     {{TIMES, "ribbon.young_modulus", 1.6, 1e-3}}},
    {"calibrate.fit",
     FITTED " data.file=stiff.csv",
     "ribbon.young_modulus",
     "load.share",
     {{BECOMES, "load.share", 0.5, 1e-2}}},
    {"calibrate.x",
     FITTED,
     "load_mg",
     "ribbon.width_mm",
     {{BECOMES, "ribbon.width_m", 12.7e-3, 1e-9}, {SAME, "ribbon.young_modulus", 0, 1e-6}}},
    {"calibrate.y", FITTED, "stroke_mm", "stroke_um", {{TIMES, "ribbon.young_modulus", 2, 1e-3}}},
    {"calibrate.sigma",
     FITTED,
     "stroke=1um",
     "stroke=2um",
     {{TIMES, "ribbon.young_modulus_standard_error", 2, 1e-6}, {SAME, "ribbon.young_modulus", 0, 1e-6}}},
    {"calibrate.lower", FITTED, "0.2", "0.8", {{TIMES, "ribbon.young_modulus", 1.6, 1e-3}}},
    {"calibrate.upper", FITTED " data.file=stiff.csv", "5", "1.5", {{TIMES, "ribbon.young_modulus", 0.75, 1e-3}}},

    {"cycle.method",
     "study=cycle mesh.nodes=7 drive.voltage=300V drive.waveform=sine",
     "motion",
     "linear",
     {{TIMES, "stroke_amplitude_m", 1, 5e-3}, {BECOMES, "linear", 1, 0}}},
    {"cycle.tolerance",
     "study=cycle mesh.nodes=7 drive.voltage=3kV drive.waveform=sine cycle.method=motion",
     "0.1",
     "1e-6",
     {{MORE, "cycles", 1.3, 0}, {TIMES, "opening_max_m", 1, 1e-2}}},
    {"cycle.most_cycles",
     "study=cycle mesh.nodes=7 drive.voltage=10kV drive.waveform=sine",
     "3",
     "5",
     {{BECOMES, "cycles", 5, 0}}},

    {"sensitivity.by", "study=stationary", "gravity", "gravity,load.mass", {{PLUS, "derivatives", 2, 0}}},

    /* along a uniform gap the field softens a strip by 2 W / h per length, as much in every mode */
    {"modes.voltage",
     "study=modes electro.breakdown_cap=false electro.gap_offset=1mm electro.insulator_offset=100um " FLANGE,
     "0",
     "500V",
     {{PLUS, "frequency_1_Hz", -SOFTENING / (2 * FIRST_MODE), 2e-2},
      {PLUS, "frequency_2_Hz", -SOFTENING / (2 * SECOND_MODE), 6e-2}}},

    /* linear: what bends the ribbons apart */
    {"isometric.separation",
     HELD " ribbon.density=0",
     "0.2mm",
     "0.4mm",
     {{TIMES, "force_unpowered_N", 2, 1e-3}, {TIMES, "opening_m", 2, 1e-6}}},
    /* a strip that is hardly bent is a cubic, one that is bent far is not */
    {"profile.shape",
     PROFILE " isometric.separation=0.2mm gravity=0 drive.voltage=1V mesh.nodes=61",
     "cubic",
     "held",
     {{TIMES, "force_N", 1, 1e-3}}},
    {"profile.shape", PROFILE " isometric.separation=20mm", "cubic", "held", {{TIMES, "force_N", 0.9882, 5e-3}}},
    {"profile.paper_factor",
     PROFILE,
     "false",
     "true",
     {{BECOMES, "paper_factor", 6.04, 2e-3}, {SAME, "force_N", 0, 1e-12}}},

    {"output.samples", SWING, "40", "20", {{LESS, "rows", 0.75, 0}, {SAME, "stroke_m", 0, 0}}},
    {"output.shapes", SWING, "40", "20", {{LESS, "frames", 0.75, 0}, {SAME, "stroke_m", 0, 0}}},
    /* with n elements the sag is wrong by q L^4 / (24 EI n^3): by eq. (21.2) 8 elements beside 20 count, F = 1.75 */
    {"output.errors",
     SAGS,
     "false",
     "true",
     {{BECOMES, "stroke_error_m",
       7850 * 12.7e-3 * 50e-6 * 1e-3 * CUBE(50e-3) * 50e-3 / (24 * EI) * 1.75 * (1.0 / CUBE(8) - 1.0 / CUBE(20)) /
           (6.25 - 1),
       1e-3},
      {SAME, "stroke_m", 0, 0}}},
};

/* -- how they are run ------------------------------------------------------------------------------ */

/* "key=value key=value" into the scenario; what stands later wins. */
static void set_all(ZpScenario *scenario, const char *settings) {
  char copy[1024], *rest = NULL;
  ZpError err;
  ck_assert_uint_lt(strlen(settings), sizeof copy);
  memcpy(copy, settings, strlen(settings) + 1);
  for (char *word = strtok_r(copy, " ", &rest); word; word = strtok_r(NULL, " ", &rest))
    ck_assert_msg(zp_scenario_set(scenario, word, &err) == ZP_OK, "%s: %s", word, err.message);
}

/* A scene with key = value; without liquid unless the scene has one. */
static ZpScenario *scenario_of(const char *scene, const char *key, const char *value) {
  ZpScenario *scenario = new_scenario();
  char setting[256];
  snprintf(setting, sizeof setting, "%s=%s", key, value);
  set_all(scenario, "liquid.model=none");
  set_all(scenario, scene);
  set_all(scenario, setting);
  return scenario;
}

static ZpActuatorDef def_of(const ZpScenario *scenario) {
  ZpActuatorDef def;
  ZpError err = {ZP_OK, ""};
  ck_assert_msg(zp_scenario_def(scenario, 0, &def, &err) == ZP_OK, "%s", err.message);
  return def;
}

/* The study of a scene. */
static ZpResult *run_scene(const char *scene, const char *key, const char *value) {
  ZpScenario *scenario = scenario_of(scene, key, value);
  ZpActuatorDef def = def_of(scenario);
  ZpResult *result;
  ZpError err = {ZP_OK, ""};
  ck_assert_msg(zp_data_study_run(zp_scenario_study(scenario), &def, NULL, &result, &err) == ZP_OK, "%s %s=%s: %s",
                scene, key, value, err.message);
  return zp_test_owns(result, destroy_result);
}

/* A number of the summary, how much of something there is, or what a column ends with. */
static double output_of(const ZpResult *result, const char *name) {
  if (strcmp(name, "rows") == 0) return (double)result->series->rows;
  if (strcmp(name, "frames") == 0) return (double)result->shapes->frames;
  if (strcmp(name, "derivatives") == 0) return (double)result->sensitivities;
  if (strcmp(name, "notes") == 0) return (double)result->notes;
  double value = zp_result_get(result, name);
  return isnan(value) ? zp_table_get(result->series, result->series->rows - 1, name) : value;
}

static bool has_effect(const Effect *effect, double from, double to) {
  double expected = effect->expected, off = effect->tolerance * fabs(expected);
  switch (effect->change) {
  case TIMES:
    return from != 0 && fabs(to / from - expected) <= off;
  case PLUS:
    return fabs(to - from - expected) <= off;
  case BECOMES:
    return !(from == to) && fabs(to - expected) <= off;
  case MORE:
    return to > expected * from;
  case LESS:
    return to < expected * from;
  case SAME:
    return fabs(to - from) <= effect->tolerance * fabs(from);
  }
  return false;
}

TESTS(key_acts, 0, LENGTH_OF(rows)) {
  if (SANITIZED && _i % 4) return; /* test_bounds runs with every key */
  const Row *row = &rows[_i];
  ZpResult *from = run_scene(row->scene, row->key, row->from), *to = run_scene(row->scene, row->key, row->to);
  for (int k = 0; k < EFFECTS && row->effect[k].output; k++) {
    const Effect *effect = &row->effect[k];
    double a = output_of(from, effect->output), b = output_of(to, effect->output);
    ck_assert_msg(has_effect(effect, a, b), "%s, %s => %s: %s %.10g => %.10g, ratio %.10g, expected %.10g within %g",
                  row->key, row->from, row->to, effect->output, a, b, b / a, effect->expected, effect->tolerance);
  }
}

/* -- a campaign computes a case again if a key of it has changed ----------------------------------- */

static uint64_t hash_of(const Row *row, const char *value) {
  ZpScenario *scenario = scenario_of(row->scene, row->key, value);
  ZpActuatorDef def = def_of(scenario);
  uint64_t start;
  ck_assert_int_eq(zp_campaign_hash(zp_scenario_study(scenario), &def, &start, NULL), ZP_OK);
  return zp_case_hash(start, &def);
}

/* What acts is part of a case: a row of the journal counts for the same value only. */
TESTS(key_is_part_of_a_case, 0, LENGTH_OF(rows)) {
  const Row *row = &rows[_i];
  ck_assert_msg(hash_of(row, row->from) == hash_of(row, row->from), "%s: two hashes of one case", row->key);
  ck_assert_msg(hash_of(row, row->from) != hash_of(row, row->to), "%s: one hash of two cases", row->key);
}

/* The only case of a campaign in the present folder, which may have a journal of another. */
static void compute(const Row *row, const char *value, const char *folder, double *outputs) {
  ZpScenario *scenario = scenario_of(row->scene, row->key, value);
  const ZpCampaignOptions options = {.jobs = 1, .resume = true};
  ZpCampaign *campaign;
  ZpError err = {ZP_OK, ""};
  ck_assert_msg(zp_campaign_open(scenario, folder, &options, &campaign, &err) == ZP_OK, "%s: %s", row->key,
                err.message);
  ck_assert_msg(zp_campaign_run(campaign, &err) == ZP_OK, "%s: %s", row->key, err.message);
  const ZpRows *all = zp_campaign_rows(campaign);
  ck_assert_uint_eq(zp_campaign_count(campaign), 1);
  const ZpResult *result = all->get(all->user, 0);
  for (int k = 0; k < EFFECTS; k++)
    outputs[k] = row->effect[k].output ? zp_result_get(result, row->effect[k].output) : 0;
  zp_campaign_close(campaign);
}

/* A campaign that is resumed after a key has changed has the results of a fresh one. */
NIGHTLY_TESTS(resumed_with_another_value_is_fresh, 0, LENGTH_OF(rows)) {
  static const char *const folders[] = {"resumed", "fresh"};
  double outputs[2][EFFECTS];
  for (int k = 0; k < 2; k++) {
    char journal[64];
    mkdir(folders[k], 0777);
    snprintf(journal, sizeof journal, "%s/journal.sqlite", folders[k]);
    unlink(journal);
  }
  compute(&rows[_i], rows[_i].from, folders[0], outputs[0]);
  for (int k = 0; k < 2; k++)
    compute(&rows[_i], rows[_i].to, folders[k], outputs[k]);
  ck_assert_mem_eq(outputs[0], outputs[1], sizeof outputs[0]);
}

/* -- every key has a row --------------------------------------------------------------------------- */

/* What is written or drawn, or which cases are run, which no study knows: test_report, test_scenario,
 * test_campaign.py and test_optimize.py. */
static bool is_of_files(const char *key) {
  static const char *const files[] = {"output.series", "output.plots", "output.animation", "solver.max_cpu_time"};
  bool found = strncmp(key, "sampling.", 9) == 0 || strncmp(key, "optimize.", 9) == 0;
  for (size_t i = 0; i < LENGTH_OF(files); i++)
    found |= strcmp(files[i], key) == 0;
  return found;
}

TESTS(key_has_a_row, 0, zp_key_count()) {
  const char *key = zp_key(_i)->name;
  bool found = is_of_files(key);
  for (size_t i = 0; i < LENGTH_OF(rows); i++)
    found |= strcmp(rows[i].key, key) == 0 && rows[i].effect[0].output;
  ck_assert_msg(found, "%s has no row: which output does it change, by how much?", key);
}

/* -- files ----------------------------------------------------------------------------------------- */

/* Where a run stands that began to hang and was cut. */
static void write_checkpoint(const char *name, const char *end_time) {
  ZpResult *result = run_scene(HANGING, "solver.end_time", end_time);
  FILE *file = fopen(name, "wb");
  ck_assert(file && zp_checkpoint_write(result->checkpoint, file, NULL) == ZP_OK && fclose(file) == 0);
}

/* Strokes of STRIP at two loads, by P L^3 / (12 E I), in mm; half of them as another column. */
static void write_strokes(const char *name, double E) {
  FILE *file = fopen(name, "w");
  ck_assert_ptr_nonnull(file);
  fprintf(file, "load_mg, stroke_mm, stroke_um, ribbon.width_mm\n");
  for (int mg = 5; mg <= 10; mg += 5) {
    double mm = 1e3 * mg * 1e-6 * 9.81 * CUBE(0.1) / (12 * EI * E / 200e9);
    fprintf(file, "%d, %.12g, %.12g, 12.7\n", mg, mm, 500 * mm);
  }
  ck_assert_int_eq(fclose(file), 0);
}

static void write_files(void) {
  write_file("fast.csv", "time_ms,voltage_kV\n0,0\n2,2\n");
  write_file("slow.csv", "time_ms,voltage_kV\n0,0\n4,2\n");
  write_file("rises.csv", "time_ms,setpoint_pF\n0,300\n18,500\n");
  write_file("rises_slowly.csv", "time_ms,setpoint_pF\n0,300\n36,500\n");
  write_checkpoint("early.zps", "1ms");
  write_checkpoint("late.zps", "2ms");
  write_strokes("soft.csv", 100e9);
  write_strokes("stiff.csv", 400e9);
}

AROUND_ALL(write_files, NULL)
