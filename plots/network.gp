#picture members.svg one motion :bodies
# Heights of the bodies of a network, in the plane their angles, and openings of its members, over time.
load 'functions.gp'
turns = exists('in_plane')
title = (turns ? 'Angles' : 'Heights').' of the bodies and openings of the members over time'
load 'note.gp'
load 'over_time.gp'
load 'upper_panel.gp'
list = ''
do for [name in bodies_named] { list = list.name.(turns ? '.angle_rad ' : '.y_m ') }
titles = escaped(bodies_named)
quantity = turns ? 'angle' : 'height'
si = turns ? 'rad' : 'm'
sized = list
load 'curves.gp'
load 'lower_panel.gp'
list = ''
do for [name in members_named] { list = list.name.'.opening_m ' }
titles = escaped(members_named)
quantity = 'opening'
si = 'm'
sized = list
load 'curves.gp'
unset multiplot
