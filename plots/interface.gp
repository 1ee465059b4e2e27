# Charge that leaks to the interface of insulators and liquid.
title = 'Charge between insulators and liquid over time'
foot = note
load 'over_time.gp'
load 'upper_panel.gp'
list = 'voltage_V interface_voltage_V'
titles = 'voltage interface'
quantity = 'voltage'
si = 'V'
sized = 'voltage_V interface_voltage_V'
load 'curves.gp'
load 'lower_panel.gp'
list = 'opening_m'
titles = 'opening'
quantity = 'length'
si = 'm'
sized = 'opening_m stroke_m'
load 'curves.gp'
unset multiplot
