# The axis of states of rest along the voltage, and what their curves look like: `kinds` are those that there are. Row r of
# the table is a state of kind kind_of[r], from 0, at the voltage voltage_of[r], with travel_of[r], how far it has closed.
letters = 16
load 'style.gp'
set datafile separator ','
set datafile columnheaders
voltage = scale(drive_voltage, 'V')
voltage_unit = unit(drive_voltage, 'V')
set xrange [0:drive_voltage*voltage]
xlabel = label('voltage', voltage_unit)
set xlabel xlabel
load 'functions.gp'
travel = kind eq 'held_branch' ? 'force_N' : has('strain') ? 'strain' : has('opening_m') ? 'opening_m' : 'stroke_m'
array kind_of[rows]
array voltage_of[rows]
array travel_of[rows]
_kind(c) = !(column('stable') > 0) + (has('branch') ? 2*(column('branch') > 0) : 0)
_fill(r) = (kind_of[r] = _kind(0), voltage_of[r] = column('voltage_V'), travel_of[r] = column(travel))
stats '../table.csv' using (_fill(int(column(0)) + 1), 1) nooutput
kind_list = 'stable unstable closed_stable closed_unstable'
kind_titles = 'stable unstable "stable, closed" "unstable, closed"'
_has_kind(k) = (sum [r=1:rows] (kind_of[r] == k)) > 0
kinds = ''
do for [k=0:3] { if (_has_kind(k)) { kinds = kinds.word(kind_list, k + 1).' ' } }
kind_title(k) = word(kind_titles, place(word(kinds, k), kind_list))
kind_colour(k) = word('#0072b2 #d55e00 #009e73 #b8a800', place(word(kinds, k), kind_list))
kind_width(k) = word('2.5 1.5 2.5 1.5', place(word(kinds, k), kind_list)) + 0
kind_dash(k) = word('1 2 6 3', place(word(kinds, k), kind_list)) + 0
