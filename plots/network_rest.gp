#picture stroke.svg one branch :bodies +drive.voltage
# Heights of the bodies of a network at rest, and openings of its members, against the voltage: stable states only.
load 'functions.gp'
title = 'Heights of the bodies and openings of the members at rest'
remark = 'stable states against the voltage of the top level'
letters = 16
load 'style.gp'
set datafile separator ','
set datafile columnheaders
voltage = scale(drive_voltage, 'V')
set xrange [0:drive_voltage*voltage]
xlabel = label('voltage', unit(drive_voltage, 'V'))
load 'upper_panel.gp'
list = ''
do for [name in bodies_named] { list = list.name.'.y_m ' }
titles = escaped(bodies_named)
quantity = 'height'
load 'stable_points.gp'
load 'lower_panel.gp'
list = ''
do for [name in members_named] { list = list.name.'.opening_m ' }
titles = escaped(members_named)
quantity = 'opening'
load 'stable_points.gp'
unset multiplot
