# Openings of actuators in series over time: the order in which they zip.
title = 'Openings of the members over time'
foot = note
remark = 'member 1 is the uppermost'
letters = 8
load 'style.gp'
set datafile separator ','
set xrange [0:*]
time = scale(largest('time_s'), 's')
length = scale(largest('member_1_opening_m member_2_opening_m'), 'm')
set xlabel label('time', unit(largest('time_s'), 's'))
set ylabel label('opening', unit(largest('member_1_opening_m member_2_opening_m'), 'm'))
plot for [k=1:stack_series] '../table.csv' using (column('time_s')*time):(column(sprintf('member_%d_opening_m', k))*length) \
     with lines lw 2 dt dash(k) lc rgb colour(k) title sprintf('member %d', k)
