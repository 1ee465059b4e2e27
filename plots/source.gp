#picture source.svg one motion current_A @source.model
# Voltages and current of a source that is not ideal.
title = 'Voltages and current of the source over time'
load 'note.gp'
load 'over_time.gp'
load 'upper_panel.gp'
list = 'voltage_V command_V source_voltage_V'
titles = 'electrodes command inner'
quantity = 'voltage'
si = 'V'
sized = list
load 'curves.gp'
load 'lower_panel.gp'
list = 'current_A'
titles = 'current'
quantity = 'current'
si = 'A'
sized = 'current_A'
load 'curves.gp'
unset multiplot
