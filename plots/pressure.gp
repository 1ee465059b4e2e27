#picture pressure.svg one motion >pressure_Pa stroke_m
# Strain of a pouch, and pressure of its liquid.
title = 'Strain of the pouch and pressure of its liquid over time'
load 'note.gp'
load 'over_time.gp'
load 'upper_panel.gp'
set ylabel 'strain / %' offset 0.5
set ytics step(100*span('stroke_m')/(pouch_count*ribbon_length), 5)
plot '../table.csv' using (column('time_s')*time):(100*column('stroke_m')/(pouch_count*ribbon_length)) with lines lw 2 lc rgb colour(1) title 'strain'
load 'lower_panel.gp'
from_zero = 1
list = 'pressure_Pa'
titles = 'pressure'
quantity = 'pressure'
si = 'Pa'
sized = list
load 'curves.gp'
unset multiplot
