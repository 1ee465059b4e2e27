# At most `y_tics` tics for the columns `list`, times `factor`; where `from_zero`, the axis reaches from 0, and to `reach`.
# What varies by less than a thousandth of its size is drawn as constant: else all tics would have the same label.
if (!exists('y_tics')) { y_tics = 8 }
if (!exists('from_zero')) { from_zero = 0 }
if (!exists('reach')) { reach = 0 }
if (exists('y_constant')) { unset offsets; undefine y_constant }
y_size = largest(list)*factor
y_range = span(list)*factor
if (from_zero) {
  set yrange [*<0:reach<*]
  y_range = max(y_size, reach)
}
if (y_range < 1e-3*y_size) {
  y_constant = 1
  y_range = 0.04*y_size
  set offsets 0, 0, y_range/2, y_range/2
}
if (y_range > 0) { set ytics step(y_range, y_tics) } else { set ytics autofreq }
