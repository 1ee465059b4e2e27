#picture electric.svg one motion charge_C force_N opening_m
# Charge and electric force of a run.
title = 'Charge and electric force of the whole actuator over time'
load 'over_time.gp'
load 'upper_panel.gp'
list = 'charge_C'
titles = 'charge'
quantity = 'charge'
si = 'C'
sized = 'charge_C'
load 'curves.gp'
load 'lower_panel.gp'
list = 'force_N'
titles = 'force'
quantity = 'force'
si = 'N'
sized = 'force_N'
load 'curves.gp'
unset multiplot
