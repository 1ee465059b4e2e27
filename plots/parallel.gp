# All cases of a sweep: an axis for each key and each answer, a line for each case, coloured by axis `colour_axis`.
# Names are above, aslant so that they do not meet, the ends of the ranges at both ends.
title = 'All cases: a line for each'
remark = sprintf('%d cases; those without a value on an axis are left out', cases)
left = 0.03
right = 0.80
height = 480
load 'style.gp'
unset grid
unset xtics
unset ytics
set border 0
set yrange [0:1]
set xrange [-0.2:|axis_name| - 0.8]
size(k) = max(abs(axis_low[k]), abs(axis_high[k]))
factor(k) = axis_factor[k]*scale(size(k), axis_si[k])
name(k) = label(axis_name[k], axis_unit[k].unit(size(k), axis_si[k]))
do for [k=1:|axis_name|] {
  i = k - 1
  set arrow i+10 from i,0 to i,1 nohead lw 1.2 lc rgb '#333333' front
  set label 3*i+10 sprintf('%.4g', axis_high[k] * factor(k)) at i,1 center offset 0,0.7 font ',11'
  set label 3*i+11 sprintf('%.4g', axis_low[k] * factor(k)) at i,0 center offset 0,-0.7 font ',11'
  set label 3*i+12 name(k) at i,1 left rotate by 30 offset -0.5,1.8 font ',11'
}
load 'scale_of_shades.gp'
set bmargin at screen bottom - 0.05
set tmargin at screen 0.65
set colorbox user origin 0.845, bottom - 0.05 size 0.025, 0.65 - bottom
set cblabel name(colour_axis) offset 0.5
set key at screen 0.97, 0.955 right top noreverse Right
if (objectives > 0) {
  plot 'parallel.dat' index 0 using 1:2:($3*factor(colour_axis)) with lines lw 0.8 lc palette notitle, \
       '' index 1 using 1:2 with lines lw (objectives > 1 ? 1.5 : 3) lc rgb '#000000' title (objectives > 1 ? 'front' : 'best')
} else {
  plot 'parallel.dat' index 0 using 1:2:($3*factor(colour_axis)) with lines lw 0.8 lc palette notitle
}
