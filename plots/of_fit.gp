# Panel k of a calibration: columns and ranges. Column x_in[k] is what was set; from y_in[k] on are what was
# measured, what was computed, their difference, and, where `weighted`, the standard deviation.
x(c) = column(x_in[k])*x_factor[k]
measured(c) = column(y_in[k])
computed(c) = column(y_in[k] + 1)
residual(c) = column(y_in[k] + 2)
sigma(c) = column(y_in[k] + 3)
bar(c) = weighted ? sigma(c) : NaN # half of an error bar
title_measured = weighted ? 'measured ± σ' : 'measured'
stats data using (x(0)):(measured(0)) name 'measured' nooutput
stats data using (x(0)):(computed(0)) name 'computed' nooutput
stats data using (x(0)):(residual(0)) name 'residual' nooutput
stats data using (x(0)):(residual(0) + (weighted ? sigma(0) : 0)) name 'above' nooutput
stats data using (x(0)):(residual(0) - (weighted ? sigma(0) : 0)) name 'below' nooutput
size(low, high) = max(abs(low), abs(high))
both = max(size(measured_min_y, measured_max_y), size(computed_min_y, computed_max_y))
y_factor = scale(both, si[k])
rest = size(residual_min_y, residual_max_y)
rest_factor = scale(rest, si[k])
