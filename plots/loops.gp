#picture loops.svg one motion opening_m|contraction =energy_per_cycle_J
# One cycle: voltage against charge, electric force against the opening; of one ribbon against its stroke, or its
# contraction where its end is held.
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
x_column = has('opening_m') ? 'opening_m' : highest_stroke_m > lowest_stroke_m ? 'stroke_m' : 'contraction'
x_si = x_column eq 'contraction' ? '%' : 'm'; x_name = x_column eq 'contraction' ? x_column : x_column[1:strlen(x_column) - 2]
y_column = 'force_N'; y_si = 'N'; y_name = 'electric force'
load 'loop.gp'
unset multiplot
