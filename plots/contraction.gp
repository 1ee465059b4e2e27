#picture contraction.svg many motion :series.dat
# Contraction, or the stroke of a single ribbon, of all runs of a sweep over time. Some of the cases are named: run[i],
# from 0, is name[i]. Few runs have colours that differ much, more a scale from dark to light; those that all have a name
# have dashes of their own, too.
load 'functions.gp'
ribbon = actuator_kind eq 'ribbon'
title = ribbon ? 'Stroke over time' : 'Contraction over time'
load 'note.gp'
named = cases < 10 ? cases : 10
array run[named]
array name[named]
do for [i=1:named] {
  run[i] = named > 1 ? (i - 1)*(cases - 1)/(named - 1) : 0
  name[i] = case_name(run[i], words(axes))
}
letters = letters_of(words(axes))
do for [i=1:|run|] { letters = max(letters, strlen(name[i])) }
load 'style.gp'
set key spacing 1 title legend(words(axes)) left font ',12'
stats 'series.dat' using 2:3 name 'over' nooutput
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
  plot for [i=1:|run|] 'series.dat' using ($2*time):($1 == run[i] ? $3*factor : NaN) \
       with lines lw 2 dt dash(i) lc rgb run_colour(run[i]) title name[i]
} else {
  plot 'series.dat' using ($2*time):($3*factor):(run_colour(int($1))) with lines lw 2 lc rgb variable notitle, \
       for [i=1:|run|] NaN with lines lw 2 lc rgb run_colour(run[i]) title name[i]
}
