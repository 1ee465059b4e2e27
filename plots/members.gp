#picture members.svg one motion member_1_opening_m @stack.series
# Openings of actuators in series over time: the order in which they zip.
title = 'Openings of the members over time'
load 'note.gp'
remark = 'member 1 is the uppermost'
members = stack_series
letters = strlen(sprintf('member %d', members))
load 'style.gp'
list = ''
do for [k=1:members] { list = list.sprintf('member_%d_opening_m ', k) }
load 'of_members.gp'
set datafile separator ','
set xrange [0:*]
time = scale(largest('time_s'), 's')
length = scale(largest(list), 'm')
set xlabel label('time', unit(largest('time_s'), 's'))
set ylabel label('opening', unit(largest(list), 'm'))
plot for [k=1:members] '../table.csv' using (column('time_s')*time):(column(word(list, k))*length) \
     with lines lw (k == 1 ? 4 : 2) dt member_dash(k) lc rgb member_colour(k) title member_title(k)
