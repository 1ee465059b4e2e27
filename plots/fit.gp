# Measurements and fit, below them the residuals, against what was set on the bench.
title = fitted ? 'Measured and fitted' : 'Measured and computed'
right = 0.82
load 'style.gp'
size(low, high) = max(abs(low), abs(high))
# logarithmic axes where linear ones would hide most points in a corner
spans_decades(low, high) = low > 0 && high > 20*low
both = max(size(measured_low, measured_high), size(computed_low, computed_high))
y_factor = scale(both, si)
set ylabel label(quantity, unit(both, si)) offset 0.5
if (spans_decades(x_low, x_high) && spans_decades(measured_low, measured_high)) {
  set logscale xy
  set offsets graph 0.1, graph 0.1, graph 0.1, graph 0.1
} else {
  set autoscale noextend
  set yrange [0:*]
  set offsets graph 0.04, graph 0.04, graph 0.06, 0
}
set multiplot
set bmargin at screen 0.38
set format x ''
plot 'fit.dat' using ($1*x_factor):($2*y_factor) with points pt 6 ps 1.2 lw 1.5 lc rgb colour(1) title 'measured', \
     'fit.dat' using ($1*x_factor):($3*y_factor) with points pt 2 ps 0.8 lw 1.5 lc rgb colour(2) title (fitted ? 'fitted' : 'computed')
rest = size(residual_low, residual_high)
rest_factor = scale(rest, si)
rest_range = max(residual_high, 0) - (residual_low < 0 ? residual_low : 0)
if (rest_range > 0) set ytics step(rest_range*rest_factor, 4)
unset label
set tmargin at screen 0.33
set bmargin at screen 0.12
set format x
set xlabel x_label
set ylabel label('residual', unit(rest, si)) offset 0.5
unset logscale y
set yrange [*:*]
set offsets graph 0.04, graph 0.04, graph 0.15, graph 0.15
set xzeroaxis lt 1 lw 1 lc rgb '#555555'
plot 'fit.dat' using ($1*x_factor):(($3-$2)*rest_factor) with impulses lw 1.5 lc rgb colour(2) notitle, \
     'fit.dat' using ($1*x_factor):(($3-$2)*rest_factor) with points pt 7 ps 0.6 lc rgb colour(2) notitle
unset multiplot
