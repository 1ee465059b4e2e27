#picture members.svg one motion :bodies
# Heights of the bodies of a network, and openings of its members, over time.
load 'functions.gp'
title = 'Heights of the bodies and openings of the members over time'
load 'note.gp'
load 'over_time.gp'
load 'upper_panel.gp'
list = ''
do for [name in bodies_named] { list = list.name.'.y_m ' }
titles = escaped(bodies_named)
quantity = 'height'
si = 'm'
sized = list
load 'curves.gp'
load 'lower_panel.gp'
list = ''
do for [name in members_named] { list = list.name.'.opening_m ' }
titles = escaped(members_named)
quantity = 'opening'
sized = list
load 'curves.gp'
unset multiplot
