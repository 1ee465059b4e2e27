# What a meter of the capacitance reads.
title = 'Stroke by its capacitance over time'
foot = note
load 'over_time.gp'
load 'upper_panel.gp'
list = 'stroke_m sensed_stroke_m'
titles = 'stroke "by capacitance"'
quantity = 'stroke'
si = 'm'
sized = 'stroke_m'
load 'curves.gp'
load 'lower_panel.gp'
list = 'capacitance_F sensed_capacitance_F'
titles = 'capacitance "as it is read"'
quantity = 'capacitance'
si = 'F'
sized = 'capacitance_F'
load 'curves.gp'
unset multiplot
