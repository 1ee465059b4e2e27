#picture pareto.svg many motion|branch|held_branch|shape|modes|field|limits :front
# Two objectives of an optimisation against each other, with the front: rows front[k] of the table.
load 'functions.gp'
title = 'Pareto front'
remark = sprintf('%d of %d cases are on the front; others are worse, or miss a constraint', |front|, cases)
letters = 6
load 'style.gp'
set datafile missing NaN
set datafile separator ','
set datafile columnheaders
array objective[2]
array objective_si[2]
do for [k=1:2] {
  objective[k] = word(objectives, k)
  objective_si[k] = si_of(objective[k])
}
x_size = largest(objective[1])
y_size = largest(objective[2])
x(c) = column(objective[1])*scale(x_size, objective_si[1])
y(c) = column(objective[2])*scale(y_size, objective_si[2])
set xlabel label(words_of(objective[1]), unit(x_size, objective_si[1]))
set ylabel label(words_of(objective[2]), unit(y_size, objective_si[2])) offset 0.5
set autoscale noextend
set offsets graph 0.03, graph 0.03, graph 0.05, graph 0.03
on_front(i) = sum [k=1:|front|] (front[k] == i)
if (words(objectives) == 2) {
  plot '../table.csv' using (x(0)):(y(0)) with points pt 7 ps 0.4 lc rgb '#999999' title 'others', \
       '' using (x(0)):(on_front(column(0)) ? y(0) : NaN) smooth unique with linespoints lw 2 pt 7 ps 0.8 lc rgb colour(2) title 'front'
} else {
  plot '../table.csv' using (x(0)):(y(0)) with points pt 7 ps 0.4 lc rgb '#999999' title 'others', \
       '' using (x(0)):(on_front(column(0)) ? y(0) : NaN) with points lw 2 pt 7 ps 0.8 lc rgb colour(2) title 'front'
}
