# Axes and colours of maps from `data`, with at most `tics_most` tics on an axis and at most `contours` contours, of the same
# levels in all panels; where a key grows by factors its axis is logarithmic, with tics at its values.
load 'functions.gp'
none = found < cases ? '; white: no value' : ''
if (exists('answer')) {
  title = answer
  remark = answers.none.'; linear between the runs'
  what = number_name[1] eq '' ? quantity : quantity.', '.number_name[1]
} else {
  title = actuator_kind eq 'hinge' ? 'Force on the held end' : 'Force on the held platform'
  remark = sprintf('%d of %d runs are drawn', found, cases).none.'; linear between the runs'
  what = 'force'
  si = 'N'
}
lowest_value = value('lowest_'.scalar)
highest_value = value('highest_'.scalar)
if (exists('left_out')) remark = remark.left_out
right = 0.77
if (motion) foot = note
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
set pm3d interpolate 1 + 60/rows, 1 + 60/columns_across # cells so fine that they look smooth
set contour base
set cntrlabel onecolor
set style textbox opaque margins 0.4,0.4 fc rgb '#ffffff' noborder
