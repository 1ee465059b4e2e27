#picture profile.svg one field ratio +drive.voltage
# Electric force along a ribbon by the plates law and by the solved field, and their difference.
title = 'Electric force along a ribbon'
letters = 14
load 'style.gp'
set datafile separator ','
set key autotitle columnhead
set autoscale x noextend
length = scale(largest('x_m'), 'm')
both = largest('plates_N_per_m field_N_per_m')
force = scale(both, 'N/m')
load 'upper_panel.gp'
set yrange [0:*]
set ylabel 'force / ('.unit(both, 'N/m').')' offset 0.5
set ytics step(both*force, 5)
list = 'field_N_per_m plates_N_per_m'.(number('capped_length_m') > 0 ? ' force_N_per_m' : '')
titles = 'field "plates law" "with breakdown"'
width(k) = word('4 1.5 2.5', k) + 0
dash(k) = word('1 2 1', k) + 0
plot for [k=1:words(list)] '../table.csv' using (column('x_m')*length):(column(word(list, k))*force) with lines \
     lw width(k) dt dash(k) lc rgb word('#56b4e9 #000000 #d55e00', k) title word(titles, k)
xlabel = label('x from the clip', unit(largest('x_m'), 'm'))
load 'lower_panel.gp'
unset key
set autoscale y
set offsets 0, 0, graph 0.08, graph 0.05
set ylabel 'difference / %' offset 0.5
if (span('ratio') > 0) set ytics step(100*span('ratio'), 5)
plot '../table.csv' using (column('x_m')*length):(100*(column('ratio') - 1)) with lines lw 2.5 lc rgb '#0072b2' title ''
unset multiplot
