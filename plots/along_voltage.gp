# The axis of states of rest along the voltage, and what their curves look like: `kinds` are those that there are.
letters = 16
load 'style.gp'
set datafile separator ','
set datafile columnheaders
voltage = scale(drive_voltage, 'V')
voltage_unit = unit(drive_voltage, 'V')
set xrange [0:drive_voltage*voltage]
xlabel = label('voltage', voltage_unit)
set xlabel xlabel
kind_list = 'stable unstable closed_stable closed_unstable'
kind_titles = 'stable unstable "stable, closed" "unstable, closed"'
kind_title(k) = word(kind_titles, place(word(kinds, k), kind_list))
kind_colour(k) = word('#0072b2 #d55e00 #009e73 #b8a800', place(word(kinds, k), kind_list))
kind_width(k) = word('2.5 1.5 2.5 1.5', place(word(kinds, k), kind_list)) + 0
kind_dash(k) = word('1 2 6 3', place(word(kinds, k), kind_list)) + 0
