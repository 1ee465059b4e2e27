/* Instead of src/io/gnuplot.c: on Windows the command draws no pictures. It leaves each with its .gp file, which a
 * gnuplot of the user's draws. */
#include "io/drawing.h"

void zp_drawing_draw(ZpDrawing *drawing, const ZpPicture *picture, size_t count) {
  char message[1024];
  (void)picture;
  snprintf(message, sizeof message, "gnuplot was not found: pictures are not drawn; their scripts are %s/*.gp",
           drawing->folder);
  if (count > 0 && drawing->notice) drawing->notice(message);
}
