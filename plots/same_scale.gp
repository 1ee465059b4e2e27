# The same scale and tics on both axes, about `tics` of them on the longer one.
box_range = max(box_right - box_left, box_top - box_bottom)*length
if (box_range > 0) {
  set size ratio -1
  set xtics step(box_range, tics)
  set ytics step(box_range, tics)
}
