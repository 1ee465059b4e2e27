#picture charge.svg one branch|held_branch voltage_V ~charge_C capacitance_F +drive.voltage
# Charge and capacitance at rest against voltage.
title = 'Charge and capacitance at rest against voltage'
load 'along_voltage.gp'
from_zero = 1
set offsets 0, 0, graph 0.05, 0
load 'upper_panel.gp'
factor = scale(largest('charge_C'), 'C')
set ylabel label('charge', unit(largest('charge_C'), 'C')) offset 0.5
shown = 'charge_C'
load 'states.gp'
load 'lower_panel.gp'
unset key
factor = scale(largest('capacitance_F'), 'F')
set ylabel label('capacitance', unit(largest('capacitance_F'), 'F')) offset 0.5
shown = 'capacitance_F'
load 'states.gp'
unset multiplot
