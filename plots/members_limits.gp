#picture members.svg one limits member release_voltage_V @stack.series
# Voltages of each of several actuators in series. Closing is a ring, for it is often where pull-in is.
title = 'Limits of the members'
remark = 'member 1 is the uppermost'
letters = 8
load 'style.gp'
set datafile separator ','
set xrange [0.5:stack_series + 0.5]
set xtics 1
set yrange [0:*]
set xlabel 'number of the member'
voltage = scale(drive_voltage, 'V')
set ylabel label('voltage', unit(drive_voltage, 'V'))
list = 'pull_in_voltage_V closing_voltage_V release_voltage_V'
titles = 'pull-in closing release'
mark(k) = word('5 6 9', k) + 0
size(k) = word('1.2 2.2 1.5', k) + 0
plot for [k=1:3] '../table.csv' using (column('member')):(column(word(list, k))*voltage) \
     with points pt mark(k) ps size(k) lc rgb colour(k) title word(titles, k)
