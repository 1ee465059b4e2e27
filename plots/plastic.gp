# What plastic bending leaves.
title = 'What plastic bending has left over time'
foot = note
load 'over_time.gp'
load 'upper_panel.gp'
list = has('opening_m') ? 'opening_m' : 'stroke_m'
titles = has('opening_m') ? 'opening' : 'stroke'
quantity = 'length'
si = 'm'
sized = 'opening_m stroke_m'
load 'curves.gp'
load 'lower_panel.gp'
list = 'permanent_curvature_per_m'
titles = 'permanent'
quantity = 'curvature'
si = '1/m'
sized = 'permanent_curvature_per_m'
load 'curves.gp'
unset multiplot
