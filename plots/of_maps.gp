# The answer of a sweep over two list keys, or over three as some maps, panel_at[k] of the third key: as $map, an index for
# each, with axes and colours, at most `tics_most` tics on an axis and at most `contours` contours, of the same levels in all
# panels. Where a key grows by factors, over more than a decade, its axis is logarithmic, with tics at its values.
load 'answers.gp'
data = '$map'
scalar = number[1]
panels_most = 12
x_key = word(axes, words(axes))
y_key = word(axes, words(axes) - 1)
z_key = word(axes, 1)
across_map = length_of(words(axes))
up_map = length_of(words(axes) - 1)
panels = words(axes) > 2 ? length_of(1) : 1
array x_row[cases]
array y_row[cases]
array z_row[cases]
array value_row[cases]
_fill(r) = (x_row[r] = column(x_key), y_row[r] = column(y_key), z_row[r] = column(z_key), value_row[r] = column(scalar))
set datafile separator ','
set datafile columnheaders
stats '../table.csv' using (_fill(int(column(0)) + 1), 1) nooutput
set datafile separator whitespace
unset datafile columnheaders
array panel_at[min(panels, panels_most)]
set print $map
do for [k=1:|panel_at|] {
  row = (panels <= panels_most ? k - 1 : (k - 1)*(panels - 1)/(panels_most - 1))*across_map*up_map
  panel_at[k] = z_row[row + 1]
  do for [j=1:up_map] {
    do for [i=1:across_map] {
      row = row + 1
      print x_row[row], y_row[row], value_row[row]
    }
    print ''
  }
  if (k < |panel_at|) { print '' }
}
unset print
x_name = name_of(x_key); x_unit = unit_of(x_key); x_factor = of('factor_', x_key)
y_name = name_of(y_key); y_unit = unit_of(y_key); y_factor = of('factor_', y_key)
grows(a, m, b) = min(a, b) > 0 && max(a, b) >= 10*min(a, b) && m <= 0.35*max(a, b)
x_log = grows(x_row[1], x_row[(across_map - 1)/2 + 1], x_row[across_map])
y_log = grows(y_row[1], y_row[(up_map - 1)/2*across_map + 1], y_row[up_map*across_map])
x_tics = ''
y_tics = ''
if (x_log && across_map <= 12) { do for [i=1:across_map] { x_tics = x_tics.sprintf('%.8e ', x_row[i]) } }
if (y_log && up_map <= 12) { do for [j=1:up_map] { y_tics = y_tics.sprintf('%.8e ', y_row[(j - 1)*across_map + 1]) } }
none = found < cases ? '; white: no value' : ''
title = answer
remark = (study eq 'isometric' ? sprintf('%d of %d runs are drawn', found, cases) : answers).none.'; linear between the runs'
what = number_name[1] eq '' ? quantity : quantity.', '.number_name[1]
lowest_value = of('lowest_', scalar)
highest_value = of('highest_', scalar)
if (panels > panels_most) remark = remark.sprintf('; %d of %d panels', |panel_at|, panels)
if (exists('of_three') && |panel_at| > 9) height = 560
right = 0.77
if (kind eq 'motion') {
  load 'note.gp'
}
load 'style.gp'
size = max(abs(lowest_value), abs(highest_value))
factor = scale(size, si)
x_label = label(x_name, x_unit)
y_label = label(y_name, y_unit)
set xlabel x_label
set ylabel y_label offset -0.5
set cblabel label(what, unit(size, si)) offset 0.5
if (x_log) set logscale x
if (y_log) set logscale y
if (x_tics ne '') set xtics ()
if (y_tics ne '') set ytics ()
if (exists('of_three')) tics_most = |panel_at| > 4 ? 3 : 4
every(l) = (words(l) + tics_most - 1)/tics_most
do for [i=1:words(x_tics):max(1, every(x_tics))] { set xtics add (sprintf('%.4g', word(x_tics, i)*x_factor) word(x_tics, i)*x_factor) }
do for [i=1:words(y_tics):max(1, every(y_tics))] { set ytics add (sprintf('%.4g', word(y_tics, i)*y_factor) word(y_tics, i)*y_factor) }
stats data using ($1*x_factor):($2*y_factor) name 'key' nooutput
set xrange [key_min_x:key_max_x]
set yrange [key_min_y:key_max_y]
if (x_tics eq '' && !x_log) set xtics step(key_max_x - key_min_x, tics_most)
if (y_tics eq '' && !y_log) set ytics step(key_max_y - key_min_y, tics_most)
constant = highest_value - lowest_value < 1e-3*size # then contours would all have the same label
slack = constant ? 0.01*size : 0
set cbrange [(lowest_value - slack)*factor:(highest_value + slack)*factor]
if (constant) {
  set cntrparam levels discrete 2*size*factor
} else {
  apart = step((highest_value - lowest_value)*factor, contours)
  set cntrparam levels incremental ceil(lowest_value*factor/apart)*apart, apart, highest_value*factor
}
load 'scale_of_shades.gp'
unset grid
unset key
set view map
set pm3d interpolate 1 + 60/up_map, 1 + 60/across_map # cells so fine that they look smooth
set contour base
set cntrlabel onecolor
set style textbox opaque margins 0.4,0.4 fc rgb '#ffffff' noborder
