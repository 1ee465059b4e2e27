#picture members.svg one motion member_1_force_N @stack.parallel
# Forces of members side by side over time: how they share the load. An impact is many times larger than all else, so
# its peak may end outside the axes; then a line says so.
title = 'Forces of the members over time'
load 'note.gp'
members = stack_parallel
letters = strlen(sprintf('member %d', members))
load 'functions.gp'
list = ''
do for [k=1:members] { list = list.sprintf('member_%d_force_N ', k) }
load 'of_members.gp'
set datafile separator ','
stats '../table.csv' using 'member_1_force_N' name 'usual' nooutput
usual = usual_up_quartile - usual_lo_quartile + 0.1*max(abs(usual_up_quartile), abs(usual_lo_quartile))
from = usual_lo_quartile - 10*usual
to = usual_up_quartile + 10*usual
cut = _low(list, words(list)) < from || _high(list, words(list)) > to
if (cut) remark = 'peaks of impacts end outside the axes'
size = min(largest(list), max(abs(from), abs(to)))
force = scale(size, 'N')
load 'style.gp'
set xrange [0:*]
set yrange [from*force<*:*<to*force]
time = scale(largest('time_s'), 's')
set xlabel label('time', unit(largest('time_s'), 's'))
set ylabel label('force', unit(size, 'N'))
plot for [k=1:members] '../table.csv' using (column('time_s')*time):(column(word(list, k))*force) \
     with lines lw (k == 1 ? 4 : 2) dt member_dash(k) lc rgb member_colour(k) title member_title(k)
