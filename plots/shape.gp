# The loaded shape at rest: an index of the .dat per ribbon.
title = 'Shape at rest'.(half ? ', left half' : '')
right = ribbons > 1 ? 0.82 : 0.96
if (!same_scale) remark = 'x and y have different scales'
load 'style.gp'
load 'of_shapes.gp'
set autoscale noextend
set offsets graph 0.02, graph 0.02, graph 0.04, graph 0.04
tics = 10
if (same_scale) {
  load 'same_scale.gp'
}
if (stroke_m == stroke_m) set label 5 sprintf('stroke %.4g %s', stroke_m*length, length_unit) at screen 0.985,0.905 right font ',12' tc rgb '#555555'
if (ribbons > 1) {
  plot for [k=1:ribbons] 'shape.dat' index k-1 using ($1*length):($2*length) with lines lw 2.5 dt dash(k) lc rgb colour(k) \
       title word('upper lower', k)
} else {
  plot 'shape.dat' index 0 using ($1*length):($2*length) with lines lw 2.5 lc rgb colour(1) notitle
}
