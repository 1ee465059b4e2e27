/* Rules of the devices: kinds of actuators, their halves, platforms and clips. */
#include "def/rule.h"

static const ZpRule rule[] = {
    /* halves */
    ZP_RULE(PHYSICS, ZP_IS(actuator.symmetry, ZP_SYMMETRY_NONE), ZP_IS(actuator.kind, ZP_KIND_ELECTRO_RIBBON),
            "the other kinds have no halves; use actuator.symmetry half"),
    ZP_RULE(EQUATION, ZP_IS(actuator.symmetry, ZP_SYMMETRY_NONE), ZP_IS(ribbon.model, ZP_RIBBON_ROD),
            "the paper's equations are those of one half; use actuator.symmetry half"),
    ZP_RULE(EQUATION, ZP_IS(actuator.symmetry, ZP_SYMMETRY_NONE), ZP_IS(electro.surface, ZP_SURFACE_POLYLINE),
            "the paper's Bezier surface is that of one half; use actuator.symmetry half"),
    ZP_RULE(EQUATION, ZP_IS(actuator.symmetry, ZP_SYMMETRY_NONE), ZP_IS(contact.model, ZP_CONTACT_UNILATERAL),
            "the paper's zipping has the order of one half; use actuator.symmetry half"),
    ZP_RULE(NOT_MODELLED, ZP_IS(actuator.symmetry, ZP_SYMMETRY_NONE), ZP_IS(electro.model, ZP_ELECTRO_PLATES),
            "the grid of the field covers one half; use actuator.symmetry half"),
    ZP_MOTION_RULE(NOT_MODELLED, ZP_IS(actuator.symmetry, ZP_SYMMETRY_NONE),
                   ZP_IS(solver.integrator, ZP_INTEGRATOR_IMPLICIT),
                   "explicit steps are those of one half; use actuator.symmetry half"),
    /* a hinge */
    ZP_RULE(EQUATION, ZP_IS(actuator.kind, ZP_KIND_HINGE), ZP_IS(ribbon.model, ZP_RIBBON_ROD),
            "the paper's springs have no angle at a hinge; use actuator.kind electro_ribbon"),
    ZP_RULE(EQUATION, ZP_IS(actuator.kind, ZP_KIND_HINGE), ZP_IS(electro.surface, ZP_SURFACE_POLYLINE),
            "the paper's Bezier surface begins at a clip; use actuator.kind electro_ribbon"),
    ZP_RULE(EQUATION, ZP_IS(actuator.kind, ZP_KIND_HINGE), ZP_IS(contact.model, ZP_CONTACT_UNILATERAL),
            "the paper's zipping begins at a clip; use actuator.kind electro_ribbon"),
    ZP_MOTION_RULE(NOT_MODELLED, ZP_ONE_OF(actuator.kind, ZP_BIT(ZP_KIND_FLANGE) | ZP_BIT(ZP_KIND_HINGE)),
                   ZP_IS(solver.integrator, ZP_INTEGRATOR_IMPLICIT),
                   "explicit steps are those of the paper's actuator and of one ribbon"),
    ZP_MOTION_RULE(EQUATION, ZP_IS(contact.model, ZP_CONTACT_SEQUENTIAL),
                   ZP_ONE_OF(actuator.kind, ZP_BIT(ZP_KIND_ELECTRO_RIBBON) | ZP_BIT(ZP_KIND_RIBBON)),
                   "the paper's zipping begins at a clip; use contact.model unilateral"),
    ZP_MOTION_RULE(EQUATION, ZP_IS(electro.surface, ZP_SURFACE_BEZIER),
                   ZP_ONE_OF(actuator.kind, ZP_BIT(ZP_KIND_ELECTRO_RIBBON) | ZP_BIT(ZP_KIND_RIBBON)),
                   "the paper's Bezier surface begins at a clip; use electro.surface polyline"),
    /* a platform that turns */
    ZP_RULE(PHYSICS, ZP_IS(platform.rotates, true), ZP_IS(actuator.symmetry, ZP_SYMMETRY_NONE),
            "the platform of a symmetric half is level"),
    ZP_RULE(PHYSICS, ZP_IS(platform.rotates, true), ZP_ABOVE(platform.length, 0),
            "a platform without length has no angle"),
    ZP_RULE(EQUATION, ZP_IS(platform.rotates, true), ZP_IS(platform.electrode, false),
            "the attraction of platforms is modelled for level ones only"),
    ZP_RULE(EQUATION, ZP_IS(platform.rotates, true), ZP_IS(liquid.model, ZP_LIQUID_NONE),
            "the liquid between the platforms is modelled for level ones only"),
    ZP_MOTION_RULE(EQUATION, ZP_IS(platform.rotates, true), ZP_IS(load.change_mass, 0),
                   "an impact that turns the platform needs the balance of angular momentum"),
    /* what a platform that turns makes possible */
    ZP_RULE(PHYSICS, ZP_NOT(actuator.held_clip, ZP_HELD_NONE), ZP_IS(platform.rotates, true),
            "between a held clip and a guided platform the ribbons could only stretch"),
    ZP_RULE(PHYSICS, ZP_SET(load.offset), ZP_IS(platform.rotates, true),
            "on a guided platform the place of the load has no effect"),
};

static const ZpRules rules = ZP_RULES_OF(rule);
const ZpRules *const zp_rules_of_devices[] = {&rules, NULL};
