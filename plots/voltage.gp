#picture voltage.svg one motion opening_m ~voltage_V
# Voltage of a run over time, where it changes, and the opening.
title = 'Voltage and opening over time'
load 'note.gp'
load 'over_time.gp'
from_zero = 1
load 'upper_panel.gp'
list = 'voltage_V'
titles = 'voltage'
quantity = 'voltage'
si = 'V'
sized = 'voltage_V'
load 'curves.gp'
load 'lower_panel.gp'
list = 'opening_m'
titles = 'opening'
quantity = 'opening'
si = 'm'
sized = 'opening_m'
load 'curves.gp'
unset multiplot
