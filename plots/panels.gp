# Panels of a calibration, in series.dat: for each column that was set and each that was measured, x_in[k] and y_in[k]; the
# columns after a measured one are computed, the residual and, where `weighted`, sigma.
load 'functions.gp'
data = 'series.dat'
is_measured(c) = c[1:9] eq 'measured_'
weighted = 0
pairs = ''
do for [x in all_columns] {
  if (is_measured(x)) { break }
  do for [y in all_columns] {
    if (is_measured(y)) {
      x_at = place(x, all_columns) + 1
      y_at = place(y, all_columns) + 1
      n = 0
      _is(v) = v == v
      stats data using (n = n + (_is(column(x_at)) && _is(column(y_at)) && _is(column(y_at + 1))), 1) nooutput
      if (n > 0) { pairs = pairs.sprintf('%s %s ', x, y) }
    }
  }
}
panels = words(pairs)/2
array quantity[panels]
array si[panels]
array x_in[panels]
array y_in[panels]
array x_name[panels]
array x_unit[panels]
array x_factor[panels]
do for [k=1:panels] {
  x = word(pairs, 2*k - 1)
  y = word(pairs, 2*k)
  x_in[k] = place(x, all_columns) + 1
  y_in[k] = place(y, all_columns) + 1
  si[k] = of('si_', y)
  help = of('help_', y) # 'force in data.file'
  quantity[k] = help[1:strstrt(help.' in data.file', ' in data.file') - 1]
  is_key = exists('name_'.plain(x))
  x_name[k] = is_key ? name_of(x) : 'time'
  x_unit[k] = is_key ? unit_of(x) : of('si_', x)
  x_factor[k] = is_key ? of('factor_', x) : 1.0
  if (k == 1) { weighted = word(all_columns, y_in[1] + 2)[1:6] eq 'sigma_' }
}
