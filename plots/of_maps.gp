# Axes and colours of maps; where a key grows by factors its axis is logarithmic, with tics at its values.
right = 0.82
if (motion) foot = note
load 'style.gp'
size = max(abs(lowest_value), abs(highest_value))
factor = scale(size, si)
set xlabel x_label
set ylabel y_label offset 0.5
set autoscale xfix
set autoscale yfix
set cblabel label(quantity, unit(size, si)) offset 0.5
if (x_log) set logscale x
if (y_log) set logscale y
if (x_tics ne '') eval 'set xtics ('.x_tics.')'
if (y_tics ne '') eval 'set ytics ('.y_tics.')'
load 'scale_of_shades.gp'
unset grid
unset key
set view map
set pm3d interpolate 1 + 60/rows, 1 + 60/columns_across # cells so fine that they look smooth
set contour base
set cntrlabel onecolor start 2 interval -1 font ',11'
