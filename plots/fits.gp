#picture fits.svg one fit :panels
#picture fits.svg many fit :panels
# Measurements of several kinds and one fit to all of them: a row each, on the left measured and fitted, on the right the
# residuals, over their standard deviations where there are any.
load 'panels.gp'
title = fitted ? 'Measured and fitted' : 'Measured and computed'
right = 0.97
height = 100 + 175*panels
load 'style.gp'
at(y) = 1 - y/(1.0*height) # y in pixels from above
set label 1 title at screen 0.025, at(22)
set label 2 subtitle at screen 0.025, at(44)
set key at screen right, at(10) right top horizontal noreverse Right maxrows 1
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
  set yrange [*:*]
  set offsets graph 0.06, graph 0.06, graph 0.12, graph 0.12
  set ytics step((max(measured_max_y, computed_max_y) - (measured_min_y < computed_min_y ? measured_min_y : computed_min_y))*y_factor*1.24, 5)
  set xlabel label(x_name[k], x_unit[k]) font ',12' offset 0,0.5
  set ylabel label(quantity[k], unit(both, si[k])) font ',12' offset 0.5
  unset xzeroaxis
  plot data using (x(0)):((measured(0) - bar(0))*y_factor):(0):(2*bar(0)*y_factor) with vectors heads size screen 0.006,90 lw 1.5 lc rgb colour(1) notitle, \
       data using (x(0)):(measured(0)*y_factor) with points pt 6 ps 1.1 lw 1.5 lc rgb colour(1) title (k == 1 ? title_measured : ''), \
       data using (x(0)):(computed(0)*y_factor) with points pt 2 ps 0.7 lw 1.5 lc rgb colour(2) title (k == 1 ? (fitted ? 'fitted' : 'computed') : '')
  unset label
  set lmargin at screen 0.65
  set rmargin at screen right
  set ylabel weighted ? 'residual / σ' : label('residual', unit(rest, si[k])) font ',12' offset 0.5
  if (weighted) { stats data using (x(0)):(abs(residual(0)/sigma(0))) name 'weighted' nooutput }
  if (weighted) { set ytics step(2*max(weighted_max_y, 2.4), 5) } else { set ytics autofreq }
  if (weighted) { set yrange [*<-2.4:2.4<*] } else { set yrange [*:*] }
  set xzeroaxis lt 1 lw 1 lc rgb '#555555'
  left(c) = weighted ? residual(0)/sigma(0) : residual(0)*rest_factor
  plot data using (x(0)):(left(0)) with impulses lw 1.5 lc rgb colour(2) notitle, \
       data using (x(0)):(left(0)) with points pt 7 ps 0.6 lc rgb colour(2) notitle
}
unset multiplot
