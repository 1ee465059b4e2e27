#picture fit.svg one fit :panel
#picture fit.svg many fit :panel
# Measurements and fit, below them the residuals, against what was set on the bench.
load 'panels.gp'
title = fitted ? 'Measured and fitted' : 'Measured and computed'
letters = weighted ? 12 : 8
load 'style.gp'
k = 1
load 'of_fit.gp'
# logarithmic axes where linear ones would hide most points in a corner
spans_decades(low, high) = low > 0 && high > 20*low
set ylabel label(quantity[k], unit(both, si[k])) offset 0.5
if (spans_decades(measured_min_x, measured_max_x) && spans_decades(measured_min_y, measured_max_y)) {
  set logscale xy
  set offsets graph 0.1, graph 0.1, graph 0.1, graph 0.1
} else {
  set autoscale noextend
  set yrange [0:*]
  set offsets graph 0.04, graph 0.04, graph 0.06, 0
}
set multiplot
set bmargin at screen bottom + 0.23
set format x ''
plot data using (x(0)):((measured(0) - bar(0))*y_factor):(0):(2*bar(0)*y_factor) with vectors heads size screen 0.006,90 lw 1.5 lc rgb colour(1) notitle, \
     data using (x(0)):(measured(0)*y_factor) with points pt 6 ps 1.2 lw 1.5 lc rgb colour(1) title title_measured, \
     data using (x(0)):(computed(0)*y_factor) with points pt 2 ps 0.8 lw 1.5 lc rgb colour(2) title (fitted ? 'fitted' : 'computed')
rest_range = max(above_max_y, 0) - min(below_min_y, 0)
if (rest_range > 0) set ytics step(rest_range*rest_factor, 4)
unset label
set tmargin at screen bottom + 0.18
set bmargin at screen bottom
set format x
x_span = (measured_max_x - measured_min_x)*1.08
set xlabel label(x_name[k], x_unit[k])
set ylabel label('residual', unit(rest, si[k])) offset 0.5
unset logscale y
set yrange [*:*]
set offsets graph 0.04, graph 0.04, graph 0.15, graph 0.15
set xzeroaxis lt 1 lw 1 lc rgb '#555555'
plot data using (x(0)):(residual(0)*rest_factor) with impulses lw 1.5 lc rgb colour(2) notitle, \
     data using (x(0)):((residual(0) - bar(0))*rest_factor):(0):(2*bar(0)*rest_factor) with vectors heads size screen 0.006,90 lw 1.5 lc rgb colour(1) notitle, \
     data using (x(0)):(residual(0)*rest_factor) with points pt 7 ps 0.6 lc rgb colour(2) notitle
unset multiplot
