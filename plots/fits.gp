# Measurements of several kinds and one fit to all of them: a row each, on the left measured and fitted, on the right the
# residuals, over their standard deviations where there are any.
title = fitted ? 'Measured and fitted' : 'Measured and computed'
right = 0.97
panels = |si|
height = 110 + 190*panels
load 'style.gp'
size(low, high) = max(abs(low), abs(high))
at(y) = 1 - y/(1.0*height) # y in pixels from above
set label 1 title at screen 0.11, at(26)
set label 2 subtitle at screen 0.11, at(50)
set key at screen right, at(26) right top horizontal noreverse Right maxrows 1
set tics font ',11'
set multiplot
do for [k=1:panels] {
  above = 74 + 190*(k - 1)
  set tmargin at screen at(above)
  set bmargin at screen at(above + 132)
  set lmargin at screen 0.11
  set rmargin at screen 0.52
  both = max(size(measured_low[k], measured_high[k]), size(computed_low[k], computed_high[k]))
  y_factor = scale(both, si[k])
  set autoscale noextend
  set yrange [*:*]
  set offsets graph 0.06, graph 0.06, graph 0.12, graph 0.12
  set ytics step((max(measured_high[k], computed_high[k]) - (measured_low[k] < computed_low[k] ? measured_low[k] : computed_low[k]))*y_factor*1.24, 5)
  set xlabel x_label[k] font ',12' offset 0,0.5
  set ylabel label(quantity[k], unit(both, si[k])) font ',12' offset 0.5
  unset xzeroaxis
  plot 'fits.dat' index k-1 using ($1*x_factor[k]):($2*y_factor) with points pt 6 ps 1.1 lw 1.5 lc rgb colour(1) title (k == 1 ? 'measured' : ''), \
       'fits.dat' index k-1 using ($1*x_factor[k]):($3*y_factor) with points pt 2 ps 0.7 lw 1.5 lc rgb colour(2) title (k == 1 ? (fitted ? 'fitted' : 'computed') : '')
  unset label
  set lmargin at screen 0.63
  set rmargin at screen right
  rest = size(residual_low[k], residual_high[k])
  rest_factor = weighted ? 1 : scale(rest, si[k])
  set ylabel weighted ? 'residual / σ' : label('residual', unit(rest, si[k])) font ',12' offset 0.5
  if (weighted) { set ytics step(2*max(weighted_most[k], 2.4), 5) } else { set ytics autofreq }
  if (weighted) { set yrange [*<-2.4:2.4<*] } else { set yrange [*:*] }
  set xzeroaxis lt 1 lw 1 lc rgb '#555555'
  residual(measured, computed, sigma) = weighted ? (computed - measured)/sigma : (computed - measured)*rest_factor
  sigma_column = weighted ? 4 : 2
  plot 'fits.dat' index k-1 using ($1*x_factor[k]):(residual($2, $3, column(sigma_column))) with impulses lw 1.5 lc rgb colour(2) notitle, \
       'fits.dat' index k-1 using ($1*x_factor[k]):(residual($2, $3, column(sigma_column))) with points pt 7 ps 0.6 lc rgb colour(2) notitle
}
unset multiplot
