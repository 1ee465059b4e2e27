# Axes and colours of maps; where a key grows by factors its axis is logarithmic, with tics at its values.
load 'functions.gp'
if (exists('answer')) {
  title = answer
  remark = answers.'; straight between them'
  what = number_name[1] eq '' ? quantity : quantity.' ('.number_name[1].')'
} else {
  title = actuator_kind eq 'hinge' ? 'Force on the held end' : 'Force on the held platform'
  remark = sprintf('%d of %d runs are drawn; straight between them', found, cases)
  what = 'force'
  si = 'N'
}
lowest_value = value('lowest_'.scalar)
highest_value = value('highest_'.scalar)
right = 0.82
if (motion) foot = note
load 'style.gp'
size = max(abs(lowest_value), abs(highest_value))
factor = scale(size, si)
x_label = label(x_name, x_unit)
y_label = label(y_name, y_unit)
set xlabel x_label
set ylabel y_label offset 0.5
set autoscale xfix
set autoscale yfix
set cblabel label(what, unit(size, si)) offset 0.5
if (x_log) set logscale x
if (y_log) set logscale y
if (x_tics ne '') set xtics ()
if (y_tics ne '') set ytics ()
do for [at in x_tics] { set xtics add (sprintf('%g', at*x_factor) at*x_factor) }
do for [at in y_tics] { set ytics add (sprintf('%g', at*y_factor) at*y_factor) }
load 'scale_of_shades.gp'
unset grid
unset key
set view map
set pm3d interpolate 1 + 60/rows, 1 + 60/columns_across # cells so fine that they look smooth
set contour base
set cntrlabel onecolor start 2 interval -1 font ',11'
