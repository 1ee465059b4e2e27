#picture fits.svg one fit :panels
#picture fits.svg many fit :panels
# Measurements of several kinds and one fit to all of them: a row each, on the left measured and fitted, on the right the
# residuals over their standard deviation.
load 'panels.gp'
title = fitted ? 'Measured and fitted' : 'Measured and computed'
right = 0.97
height = 100 + 175*panels
load 'style.gp'
at(y) = 1 - y/(1.0*height) # y in pixels from above
set label 1 title at screen 0.025, at(22)
set label 2 subtitle at screen 0.025, at(44)
set key at screen right, at(3) right top vertical noreverse Right spacing 0.95 maxrows 3
set tics font ',11'
set multiplot
do for [k=1:panels] {
  above = 66 + 175*(k - 1)
  set tmargin at screen at(above)
  set bmargin at screen at(above + 118)
  set lmargin at screen 0.13
  set rmargin at screen 0.50
  load 'of_fit.gp'
  set autoscale noextend
  set offsets graph 0.06, graph 0.06, graph 0.12, graph 0.12
  set ytics step((max(measured_max_y, computed_max_y) - (measured_min_y < computed_min_y ? measured_min_y : computed_min_y))*y_factor*1.24, 5)
  set xlabel label(x_name[k], x_unit[k]) font ',12' offset 0,0.5
  set ylabel label(quantity[k], unit(both, si[k])) font ',12' offset 0.5
  unset xzeroaxis
  unset arrow
  plot data using (x(0)):((measured(0) - bar(0))*y_factor):(0):(2*bar(0)*y_factor) with vectors heads size screen 0.006,90 lw 1.5 lc rgb colour(1) notitle, \
       data using (x(0)):(measured(0)*y_factor) with points pt 6 ps 1.1*ring lw 1.5 lc rgb colour(1) title (k == 1 ? title_measured : ''), \
       for [r=1:records] data using (x(0)):(of_record(r, computed(0)*y_factor)) with lines lw 2 lc rgb colour(2) title (k == 1 && r == 1 ? title_computed : ''), \
       for [i=1:!over_time] data using (x(0)):(computed(0)*y_factor) with points pt 2 ps 0.7 lw 1.5 lc rgb colour(2) title (k == 1 ? title_computed : ''), \
       for [i=1:has_outliers] data using (x(0)):(a(measured(0)*y_factor)) with points pt 4 ps 1.6 lw 1.5 lc rgb colour(4) title (k == 1 ? 'outlier' : '')
  unset label
  set lmargin at screen 0.65
  set rmargin at screen right
  set ylabel y_label font ',12' offset 0.5
  if (over_sigma) { stats data using (abs(left(0))) name 'seen' nooutput }
  if (over_sigma) { set ytics step(2*max(seen_max, 2.4), 5) } else { set ytics autofreq }
  if (over_sigma) { set yrange [*<-2.4:2.4<*] } else { set yrange [*:*] }
  do for [i=1:2*over_sigma] { set arrow i from graph 0, first 1.96*(2*i - 3) to graph 1, first 1.96*(2*i - 3) nohead lw 1 dt 6 lc rgb '#777777' }
  set xzeroaxis lt 1 lw 1 lc rgb '#555555'
  plot data using (x(0)):(left(0)) with impulses lw 1.5*ring lc rgb colour(2) notitle, \
       data using (x(0)):(left(0)) with points pt 7 ps 0.6*ring lc rgb colour(2) notitle, \
       for [i=1:has_outliers] data using (x(0)):(a(left(0))) with points pt 4 ps 1.6 lw 1.5 lc rgb colour(4) notitle
}
unset multiplot
