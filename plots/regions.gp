#picture regions.svg one fit :regions
# Joint 95 % regions of pairs of fitted parameters, of a linear model with their covariance, and the best values; beside them
# the intervals of each alone. Of more than six pairs those with the largest correlation.
listed = regions_columns
skipped = 3
load 'of_parameters.gp'
title = 'Joint 95 % regions of pairs of fitted values'
all = 0
_pairs = ' '
_seen(p) = strstrt(_pairs, ' '.p.' ') > 0
_note(p) = (_seen(p) ? 0 : (_pairs = _pairs.p.' ', all = all + 1), 1)
set datafile separator ','
stats '../regions.csv' using (_note(sprintf('%d-%d', column('first'), column('second')))) nooutput
panels = all < 6 ? all : 6
if (all > panels) foot = sprintf('%d of %d pairs, those with the largest correlation', panels, all)
load 'grid.gp'
_is(v) = v == v
do for [k=1:panels] {
  pair = word(_pairs, k)
  one = pair[1:strstrt(pair, '-') - 1] + 0
  two = pair[strstrt(pair, '-') + 1:] + 0
  fx = factor_of(one)
  fy = factor_of(two)
  u(c) = column('first') == one && column('second') == two ? column(parameter(one))*fx : NaN
  v(c) = column(parameter(two))*fy
  set autoscale
  set offsets 0, 0, 0, 0
  stats '../regions.csv' using (u(0)):(v(0)) name 'edge' nooutput
  load 'panel.gp'
  set autoscale noextend
  set offsets graph 0.12, graph 0.12, graph 0.12, graph 0.12
  set xtics step((edge_max_x - edge_min_x)*1.24, tics)
  set ytics step((edge_max_y - edge_min_y)*1.24, 5)
  set xlabel parameter_label(one) font ',12' offset 0,0.5
  set ylabel parameter_label(two) font ',11' offset 0.5
  unset arrow
  if (_is(low_of(one)) && _is(high_of(one))) { do for [i=1:2] { e = (i == 1 ? low_of(one) : high_of(one))*fx; set arrow i from e, graph 0 to e, graph 1 nohead lw 1 dt 6 lc rgb colour(3) } }
  if (_is(low_of(two)) && _is(high_of(two))) { do for [i=3:4] { e = (i == 3 ? low_of(two) : high_of(two))*fy; set arrow i from graph 0, first e to graph 1, first e nohead lw 1 dt 6 lc rgb colour(3) } }
  plot '../regions.csv' using (u(0)):(v(0)) with filledcurves closed fc rgb colour(1) fs transparent solid 0.15 noborder notitle, \
       '' using (u(0)):(v(0)) with lines lw 2 lc rgb colour(1) title 'both', \
       NaN with lines lw 1 dt 6 lc rgb colour(3) title 'each alone', \
       '+' using (best_of(one)*fx):(best_of(two)*fy) every ::0::0 with points pt 7 ps 0.7 lc rgb colour(2) title 'best'
}
unset multiplot
