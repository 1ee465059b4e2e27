#picture stroke.svg one branch :bodies +drive.voltage
# Heights of the bodies of a network at rest, and openings of its members, or where these have none their closed
# lengths, against the voltage: stable states only.
load 'functions.gp'
load 'members_shown.gp'
title = 'Heights of the bodies and '.shown.'s of the members at rest'
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
list = of_members
titles = escaped(members_named)
quantity = shown
load 'stable_points.gp'
unset multiplot
