#picture voltages.svg one motion :ports
# Voltages of the members of a network that is on several ports, and openings or closed lengths of these members, over
# time.
load 'functions.gp'
load 'members_shown.gp'
title = 'Voltages and '.shown.'s of the members over time'
load 'note.gp'
load 'over_time.gp'
load 'upper_panel.gp'
list = ''
do for [name in members_named] { list = list.name.'.voltage_V ' }
titles = escaped(members_named)
quantity = 'voltage'
si = 'V'
sized = list
load 'curves.gp'
load 'lower_panel.gp'
list = of_members
titles = escaped(members_named)
quantity = shown
si = 'm'
sized = list
load 'curves.gp'
unset multiplot
