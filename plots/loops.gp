#picture loops.svg one motion charge_C =energy_per_cycle_J
# One cycle: voltage against charge, electric force against opening.
title = 'A cycle: the area of the left loop is what the source gives'
right = 0.97
load 'style.gp'
set datafile separator ','
set key autotitle columnhead
set multiplot
set rmargin at screen 0.48
x_column = 'charge_C'; x_si = 'C'; x_name = 'charge'
y_column = 'voltage_V'; y_si = 'V'; y_name = 'voltage'
load 'loop.gp'
unset label
set lmargin at screen 0.63
set rmargin at screen right
x_column = 'opening_m'; x_si = 'm'; x_name = 'opening'
y_column = 'force_N'; y_si = 'N'; y_name = 'electric force'
load 'loop.gp'
unset multiplot
