# Forces of members side by side over time: how they share the load. The peak of an impact ends outside the axes.
title = 'Forces of the members over time'
foot = note
letters = 8
load 'style.gp'
set datafile separator ','
set xrange [0:*]
time = scale(largest('time_s'), 's')
force = scale(largest('member_1_force_N member_2_force_N'), 'N')
set xlabel label('time', unit(largest('time_s'), 's'))
set ylabel label('force', unit(largest('member_1_force_N member_2_force_N'), 'N'))
stats '../table.csv' using (column('member_1_force_N')*force) name 'usual' nooutput
usual = usual_up_quartile - usual_lo_quartile + 0.1*max(abs(usual_up_quartile), abs(usual_lo_quartile))
set yrange [usual_lo_quartile - 10*usual<*:*<usual_up_quartile + 10*usual]
plot for [k=1:stack_parallel] '../table.csv' using (column('time_s')*time):(column(sprintf('member_%d_force_N', k))*force) \
     with lines lw 2 dt dash(k) lc rgb colour(k) title sprintf('member %d', k)
