# Two objectives of an optimisation against each other, with the front.
title = 'Pareto front'
remark = sprintf('%d of %d cases are on the front; others are worse, or miss a constraint', best, cases)
right = 0.80
load 'style.gp'
x_factor = scale(largest_value[1], si[1])
y_factor = scale(largest_value[2], si[2])
set xlabel label(objective[1], unit(largest_value[1], si[1]))
set ylabel label(objective[2], unit(largest_value[2], si[2])) offset 0.5
set offsets graph 0.03, graph 0.03, graph 0.05, graph 0.03
if (objectives == 2) {
  plot 'pareto.dat' index 0 using ($1*x_factor):($2*y_factor) with points pt 7 ps 0.4 lc rgb '#999999' title 'others', \
       '' index 1 using ($1*x_factor):($2*y_factor) with linespoints lw 2 pt 7 ps 0.8 lc rgb colour(2) title 'front'
} else {
  plot 'pareto.dat' index 0 using ($1*x_factor):($2*y_factor) with points pt 7 ps 0.4 lc rgb '#999999' title 'others', \
       '' index 1 using ($1*x_factor):($2*y_factor) with points lw 2 pt 7 ps 0.8 lc rgb colour(2) title 'front'
}
