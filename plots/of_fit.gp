# Panel k of a calibration: columns and ranges. Column x_in[k] is what was set; from y_in[k] on are what was
# measured, what was computed, their difference, and, where `weighted`, the standard deviation.
x(c) = column(x_in[k])*x_factor[k]
measured(c) = column(y_in[k])
computed(c) = column(y_in[k] + 1)
residual(c) = column(y_in[k] + 2)
sigma(c) = column(y_in[k] + 3)
bar(c) = weighted ? sigma(c) : NaN # half of an error bar
set yrange [*:*] # which statistics heed
title_measured = weighted ? 'measured ± σ' : 'measured'
stats data using (x(0)):(measured(0)) name 'measured' nooutput
stats data using (x(0)):(computed(0)) name 'computed' nooutput
stats data using (x(0)):(residual(0)) name 'residual' nooutput
size(low, high) = max(abs(low), abs(high))
both = max(size(measured_min_y, measured_max_y), size(computed_min_y, computed_max_y))
y_factor = scale(both, si[k])
rest = size(residual_min_y, residual_max_y)
rest_factor = scale(rest, si[k])
# Residuals over their standard deviation, if that is known, and what 95 of 100 are within; a(v): v of an outlier
_weighted = place('weighted_residual', all_columns) + 1
_outlier = place('outlier', all_columns) + 1
over_sigma = has('weighted_residual')
left(c) = over_sigma ? column(_weighted) + 0*residual(0) : residual(0)*rest_factor
y_label = over_sigma ? 'residual / σ' : label('residual', unit(rest, si[k]))
has_outliers = exists('highest_outlier') && highest_outlier == 1
a(v) = column(_outlier) == 1 ? v : NaN
over_time = x_name[k] eq 'time'
# records over time, each a line of its own: their number, and v in rows of record r; each pass over the data counts on
_before = 1e300
_n = 0
_record(c) = residual(0) == residual(0) ? (_n = x(0) < _before ? _n + 1 : _n, _before = x(0), _n) : 0
stats data using (_record(0)) nooutput
records = over_time ? _n : 0
of_record(r, v) = (_record(0) - 1) % records == r - 1 ? v : NaN
ring = measured_records > 60 ? 0.5 : 1
title_computed = fitted ? 'fitted' : 'computed'
