# A closed curve: column `y_column` against column `x_column`. Labels of tics stand side by side, so there are few.
x_scale = scale(largest(x_column), x_si)
y_scale = scale(largest(y_column), y_si)
set xlabel label(x_name, unit(largest(x_column), x_si))
set ylabel label(y_name, unit(largest(y_column), y_si)) offset 0.5
x_span = (value('highest_'.x_column) - value('lowest_'.x_column))*x_scale
if (x_span > 0) set xtics step(x_span, 5)
plot '../table.csv' using (column(x_column)*x_scale):(column(y_column)*y_scale) with lines lw 2 lc rgb colour(1) notitle
