#picture plan.svg one plan rank
# Expected error of the fitted keys over the number of measurements: those of the plan in their order, and as many evenly
# spaced ones of the list.
title = 'Expected error of the fitted keys'
letters = 13
load 'style.gp'
set datafile separator ','
set datafile columnheaders
load 'functions.gp'
set xlabel 'number of measurements'
set ylabel 'relative standard error / %' offset 0.5
set xtics step(max(1, highest_rank - 1), 6)
set logscale y
set format y '%g'
set autoscale noextend
set offsets graph 0.03, graph 0.03, 0, 0
plot '../table.csv' using 'rank':(100*column('even_relative_error')) with linespoints lw 2 pt 6 ps 0.8 lc rgb colour(2) title 'evenly spaced', \
     '../table.csv' using 'rank':(100*column('relative_error')) with linespoints lw 2 pt 7 ps 0.8 lc rgb colour(1) title 'planned'
