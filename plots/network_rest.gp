#picture stroke.svg one branch :bodies +drive.voltage
# Heights of the bodies of a network at rest against the voltage: stable states only.
title = 'Heights of the bodies at rest against voltage'
letters = 16
load 'style.gp'
load 'functions.gp'
set datafile separator ','
set datafile columnheaders
voltage = scale(drive_voltage, 'V')
set xrange [0:drive_voltage*voltage]
set xlabel label('voltage', unit(drive_voltage, 'V'))
list = ''
do for [name in bodies_named] { list = list.name.'.y_m ' }
factor = scale(largest(list), 'm')
set ylabel label('height', unit(largest(list), 'm')) offset 0.5
load 'y_tics.gp'
plot for [c in list] '../table.csv' using (column('stable') > 0 ? column('voltage_V')*voltage : NaN):(column(c)*factor) \
     with points pt 7 ps 0.35 lc rgb colour(place(c, list)) title escaped(word(bodies_named, place(c, list)))
