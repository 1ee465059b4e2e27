# Curves over time from the table of a run, with the small print of motions.
letters = 16
load 'style.gp'
set datafile separator ','
set key autotitle columnhead
set xrange [0:*]
time = scale(largest('time_s'), 's')
time_unit = unit(largest('time_s'), 's')
xlabel = 'time / '.time_unit
set xlabel xlabel
