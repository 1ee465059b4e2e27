#picture members.svg one motion :bodies
# Heights of the bodies of a network, in the plane their angles, or where none turns their places to the right, and openings
# of its members, or where these have none their closed lengths, over time.
load 'functions.gp'
load 'members_shown.gp'
plane = exists('in_plane')
turns = 0
do for [name in bodies_named] { if (plane && of('highest_', name.'.angle_rad') - of('lowest_', name.'.angle_rad') > 1e-3) { turns = 1 } }
title = (turns ? 'Angles' : plane ? 'Places' : 'Heights').' of the bodies and '.shown.'s of the members over time'
load 'note.gp'
load 'over_time.gp'
load 'upper_panel.gp'
list = ''
do for [name in bodies_named] { list = list.name.(turns ? '.angle_rad ' : plane ? '.x_m ' : '.y_m ') }
titles = escaped(bodies_named)
quantity = turns ? 'angle' : plane ? 'x' : 'height'
si = turns ? 'rad' : 'm'
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
