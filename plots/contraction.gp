# Contraction, or the stroke of a single ribbon, of all runs of a sweep over time. Some of the cases are named: run[i],
# from 0, is name[i]. Few runs have colours that differ much, more a scale from dark to light; those that all have a name
# have dashes of their own, too.
load 'functions.gp'
ribbon = actuator_kind eq 'ribbon'
title = ribbon ? 'Stroke over time' : 'Contraction over time'
foot = note
letters = letters_of(|list_key|)
do for [i=1:|run|] { letters = max(letters, strlen(name[i])) }
load 'style.gp'
set key spacing 1 title legend(|list_key|) left font ',12'
stats 'contraction.dat' using 1:2 name 'over' nooutput
time = scale(over_max_x, 's')
size = max(abs(over_min_y), abs(over_max_y))
factor = ribbon ? scale(size, 'm') : 100.0
set xrange [0:*]
set autoscale y noextend
set offsets 0, 0, graph 0.03, graph 0.03
set xlabel label('time', unit(over_max_x, 's'))
set ylabel (ribbon ? label('stroke', unit(size, 'm')) : 'contraction / %') offset 0.5
run_colour(k) = cases <= 8 ? colour_number(k + 1) : shade(k/(cases - 1.0))
if (cases == |run|) {
  plot for [i=1:|run|] 'contraction.dat' using ($1*time):($3 == run[i] ? $2*factor : NaN) \
       with lines lw 2 dt dash(i) lc rgb run_colour(run[i]) title name[i]
} else {
  plot 'contraction.dat' using ($1*time):($2*factor):(run_colour(int($3))) with lines lw 2 lc rgb variable notitle, \
       for [i=1:|run|] NaN with lines lw 2 lc rgb run_colour(run[i]) title name[i]
}
