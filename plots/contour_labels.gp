# A label on each contour of index `panel` of `data`, where it is farthest from the edges of the map and over no other
# label: a contour so close to an edge that its label would be cut has none. The map has its left and lower edge at
# `map_left` and `map_bottom` of the screen and is `map_width` by `map_height` pixels large.
set format xy '%g'
unset surface
set table $contours
splot data index panel using ($1*x_factor):($2*y_factor):($3*factor) with lines
unset table
set surface
at_x(x) = map_width*(x_log ? log(x/key_min_x)/log(key_max_x/key_min_x) : (x - key_min_x)/(key_max_x - key_min_x))
at_y(y) = map_height*(y_log ? log(y/key_min_y)/log(key_max_y/key_min_y) : (y - key_min_y)/(key_max_y - key_min_y))
array label_x[99]
array label_y[99]
array label_half[99]
label_count = 0
half_of(digits) = 3.5*strlen(digits) + 3
room(x, y, half) = min(min(x, map_width - x) - half, min(y, map_height - y) - 10)
is_free(x, y, half, n) = n == 0 || ((abs(x - label_x[n]) > half + label_half[n] + 3 || abs(y - label_y[n]) > 19) && is_free(x, y, half, n - 1))
best = -1
points = 0
do for [i=1:|$contours| + 1] {
  point = i > |$contours| ? '' : $contours[i]
  if (words(point) < 3 || point[1:1] eq '#') {
    if (best >= 0 && label_count < 99) {
      label_count = label_count + 1
      label_x[label_count] = best_x
      label_y[label_count] = best_y
      label_half[label_count] = half_of(digits)
      set label 100 + label_count digits at screen map_left + best_x/600.0, map_bottom + best_y/height center boxed front font ',11'
    }
    best = -1
    points = 0
  } else {
    digits = sprintf('%.3g', word(point, 3) + 0)
    x_here = at_x(word(point, 1) + 0)
    y_here = at_y(word(point, 2) + 0)
    do for [half=0:(points > 0)] {
      x_tried = half ? 0.5*(x_here + x_before) : x_here
      y_tried = half ? 0.5*(y_here + y_before) : y_here
      found_room = room(x_tried, y_tried, half_of(digits))
      if (found_room > best && is_free(x_tried, y_tried, half_of(digits), label_count)) {
        best = found_room
        best_x = x_tried
        best_y = y_tried
      }
    }
    x_before = x_here
    y_before = y_here
    points = points + 1
  }
}
