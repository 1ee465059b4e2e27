#picture shape.svg one shape :shapes.dat !:planar
# The loaded shape at rest.
load 'of_box.gp'
title = 'Shape at rest'.(half ? ', left half' : '')
if (ribbons > 1) { letters = hanging ? 9 : 6 } else { right = 0.96 }
if (!same_scale) remark = 'x and y have different scales'
if (same_scale) {
  load 'shape_ratio.gp'
}
load 'style.gp'
load 'of_shapes.gp'
tics = 10
if (same_scale) {
  load 'fill_shapes.gp'
} else {
  set autoscale noextend
  set offsets graph 0.02, graph 0.02, graph 0.04, graph 0.04
}
stroke = number('stroke_m')
if (stroke == stroke) set label 5 sprintf('stroke %.4g %s', stroke*length, length_unit) at screen 0.985, 1 - px(39.9) right font ',12' tc rgb '#555555'
film_dash(k) = hanging ? 1 : dash(k)
film_colour(k) = colour(hanging ? 1 : k)
film_title(k) = hanging ? (k == 1 ? 'films' : '') : word('upper lower', k)
if (ribbons > 1) {
  plot for [k=1:ribbons] 'shapes.dat' index 0 using (ribbon_x(k)*length):(ribbon_y(k)*length) with lines lw 2.5 dt film_dash(k) lc rgb film_colour(k) \
       title film_title(k), \
       for [k=1:hanging*ribbons] 'shapes.dat' index 0 using (ribbon_x(k)*length):(electrode_y(k)*length) with lines lw 5 lc rgb '#55626d' \
       title (k == 1 ? 'electrodes' : '')
} else {
  plot for [c=1:counter] 'shapes.dat' index 0 using (counter_x($4)*length):(counter_face(counter_x($4))*length) with lines lw 5 lc rgb '#aaaaaa' \
         title 'counter electrode', \
       'shapes.dat' index 0 using ($5*length):($6*length) with lines lw 2.5 lc rgb colour(1) notitle
}
