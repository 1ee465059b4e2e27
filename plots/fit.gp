#picture fit.svg one fit :panel
#picture fit.svg many fit :panel
# Measurements and fit, below them the residuals over their standard deviation, against time or what was set on the bench.
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
  beside = 0.1
  set offsets graph beside, graph beside, graph 0.1, graph 0.1
} else {
  set autoscale noextend
  if (!over_time) { set yrange [0:*] }
  beside = 0.04
  set offsets graph beside, graph beside, graph 0.06, 0
}
set multiplot
set bmargin at screen bottom + 0.23
set format x ''
plot data using (x(0)):((measured(0) - bar(0))*y_factor):(0):(2*bar(0)*y_factor) with vectors heads size screen 0.006,90 lw 1.5 lc rgb colour(1) notitle, \
     data using (x(0)):(measured(0)*y_factor) with points pt 6 ps 1.2*ring lw 1.5 lc rgb colour(1) title title_measured, \
     for [r=1:records] data using (x(0)):(of_record(r, computed(0)*y_factor)) with lines lw 2 lc rgb colour(2) title (r == 1 ? title_computed : ''), \
     for [i=1:!over_time] data using (x(0)):(computed(0)*y_factor) with points pt 2 ps 0.8 lw 1.5 lc rgb colour(2) title title_computed, \
     for [i=1:has_outliers] data using (x(0)):(a(measured(0)*y_factor)) with points pt 4 ps 1.6 lw 1.5 lc rgb colour(4) title 'outlier'
unset logscale y
set yrange [*:*]
stats data using (left(0)) name 'seen' nooutput
rest_range = max(max(seen_max, 0), over_sigma ? 2.4 : 0) - min(min(seen_min, 0), over_sigma ? -2.4 : 0)
if (rest_range > 0) set ytics step(rest_range, 4)
unset label
set tmargin at screen bottom + 0.18
set bmargin at screen bottom
set format x
set xlabel label(x_name[k], x_unit[k])
set ylabel y_label offset 0.5
if (over_sigma) { set yrange [*<-2.4:2.4<*] } else { set yrange [*:*] }
set offsets graph beside, graph beside, graph 0.15, graph 0.15
do for [i=1:2*over_sigma] { set arrow i from graph 0, first 1.96*(2*i - 3) to graph 1, first 1.96*(2*i - 3) nohead lw 1 dt 6 lc rgb '#777777' }
set xzeroaxis lt 1 lw 1 lc rgb '#555555'
plot data using (x(0)):(left(0)) with impulses lw 1.5*ring lc rgb colour(2) notitle, \
     data using (x(0)):(left(0)) with points pt 7 ps 0.6*ring lc rgb colour(2) notitle, \
     for [i=1:has_outliers] data using (x(0)):(a(left(0))) with points pt 4 ps 1.6 lw 1.5 lc rgb colour(4) notitle
unset multiplot
