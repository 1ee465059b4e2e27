/* The published numbers as one list. */

#include "reproduce/reproduce.h"

#include <math.h>

#define ZP_PUBLISHED(quantity, nodes, load, value) {quantity, nodes, load, #value, value},
#define ZP_TABLE_1(nodes, load, shear, stroke, error, relative, area)                                                  \
  ZP_PUBLISHED(ZP_TABLE_1_SHEAR, nodes, load, shear)                                                                   \
  ZP_PUBLISHED(ZP_TABLE_1_STROKE, nodes, load, stroke)                                                                 \
  ZP_PUBLISHED(ZP_TABLE_1_STROKE_ERROR, nodes, load, error)                                                            \
  ZP_PUBLISHED(ZP_TABLE_1_RELATIVE, nodes, load, relative)                                                             \
  ZP_PUBLISHED(ZP_TABLE_1_AREA, nodes, load, area)
#define ZP_TABLE_2(nodes, load, stroke, reference, error, relative, area)                                              \
  ZP_PUBLISHED(ZP_TABLE_2_STROKE, nodes, load, stroke)                                                                 \
  ZP_PUBLISHED(ZP_TABLE_2_REFERENCE, nodes, load, reference)                                                           \
  ZP_PUBLISHED(ZP_TABLE_2_STROKE_ERROR, nodes, load, error)                                                            \
  ZP_PUBLISHED(ZP_TABLE_2_RELATIVE, nodes, load, relative)                                                             \
  ZP_PUBLISHED(ZP_TABLE_2_AREA, nodes, load, area)
#define ZP_SECTION_3(nodes, spring, cost, step)                                                                        \
  ZP_PUBLISHED(ZP_AXIAL_SPRING, nodes, 0, spring)                                                                      \
  ZP_PUBLISHED(ZP_COST, nodes, 0, cost)                                                                                \
  ZP_PUBLISHED(ZP_MEAN_STEP, nodes, 0, step)

static const ZpPublished list[] = {
#include "reproduce/published.def"
};

enum { COUNT = sizeof list / sizeof list[0] };

const ZpPublished *zp_published_list(size_t *count) {
  *count = COUNT;
  return list;
}

double zp_published(ZpQuantity quantity, int nodes, double load) {
  for (size_t i = 0; i < COUNT; i++)
    if (list[i].quantity == quantity && list[i].nodes == nodes && list[i].load == load) return list[i].value;
  return NAN;
}
