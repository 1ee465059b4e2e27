#picture pressure.svg one motion >pressure_Pa strain
# Strain of a pouch, and pressure of its liquid.
title = 'Strain of the pouch and pressure of its liquid over time'
load 'note.gp'
load 'over_time.gp'
load 'upper_panel.gp'
list = 'strain'
titles = 'strain'
quantity = 'strain'
si = '%'
sized = list
load 'curves.gp'
load 'lower_panel.gp'
from_zero = 1
list = 'pressure_Pa'
titles = 'pressure'
quantity = 'pressure'
si = 'Pa'
sized = list
load 'curves.gp'
unset multiplot
