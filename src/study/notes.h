/* The notes of a result: sentences on what a study went through that its model or its mesh does not hold for. The one
 * place that makes those which several studies share; what a study alone knows it adds by zp_result_note. */
#ifndef ZP_STUDY_NOTES_H
#define ZP_STUDY_NOTES_H

#include <zipact/study.h>

/* The strongest fields that a study has seen, V/m. */
typedef struct ZpSeen {
  double insulator, liquid;
} ZpSeen;

/* In a plane capacitor of both insulators and `gap` (m) of liquid at `voltage` (V, any sign). */
ZpSeen zp_seen_at(const ZpModel *model, double voltage, double gap);

/* In the first `frames` of a film, NULL for none; and of two ribbons, which touch at the clip, at `highest` (V). */
ZpSeen zp_seen_in(const ZpModel *model, double highest, const ZpShapes *film, size_t frames);

/* Note breakdown of the insulator, and of the liquid where electro.breakdown_cap is false. */
void zp_note_breakdown(ZpResult *result, const ZpModel *model, ZpSeen seen);

/* Note a mesh too coarse for `voltage`, the highest (V), 0 for none. */
void zp_note_mesh(ZpResult *result, const ZpModel *model, double voltage);

/* Note a start that is nearly closed: opening of the platforms (m; NAN: there are none). */
void zp_note_start(ZpResult *result, const ZpModel *model, double opening);

#endif
