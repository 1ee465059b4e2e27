#picture modes.svg one modes :shapes.dat
# Modes about the loaded equilibrium, in rows of three panels; the first frame may be the shape at rest.
load 'of_box.gp'
at_rest = begin == 0
modes = min(6, frames - at_rest)
array frequency[modes]
set datafile separator ','
set datafile columnheaders
stats '../table.csv' using (column(0) < modes ? (frequency[int(column(0)) + 1] = column('frequency_Hz'), 1) : 1) nooutput
set datafile separator whitespace
unset datafile columnheaders
title = 'Modes about the loaded equilibrium'.(half ? ', left half' : '')
right = 0.96
remark = (at_rest ? 'grey: at rest; the' : 'the').' size of a mode is arbitrary'
load 'style.gp'
load 'of_shapes.gp'
across = 3
edge = 0.04*(box_right - box_left)
unset key
set xrange [(box_left - edge)*length:(box_right + edge)*length]
set yrange [(box_bottom - edge)*length:(box_top + edge)*length]
set xtics font ',11'
set ytics font ',11'
tics = 6
load 'same_scale.gp'
set multiplot
do for [k=1:|frequency|] {
  panel_left = left - 0.02 + 0.29*((k - 1) % across)
  panel_top = 0.81 - 0.34*((k - 1)/across)
  if (k == 2) { unset label }
  set lmargin at screen panel_left
  set rmargin at screen panel_left + 0.265
  set tmargin at screen panel_top
  set bmargin at screen panel_top - 0.26
  set label 6 sprintf('%d: %.4g Hz', k, frequency[k]) at graph 0.5,1.09 center font ',13'
  lowest = k + across > |frequency|
  first = (k - 1) % across == 0
  set format x (lowest ? '%g' : '')
  set format y (first ? '%g' : '')
  if (lowest) { set xlabel label(lying ? 'y' : 'x', length_unit) } else { unset xlabel }
  if (first) { set ylabel label(lying ? '−x' : 'y', length_unit) offset 0.5 } else { unset ylabel }
  plot for [r=1:(at_rest ? ribbons : 0)] 'shapes.dat' index 0 using (ribbon_x(r)*length):(ribbon_y(r)*length) \
         with lines lw 1.5 lc rgb '#999999' notitle, \
       for [r=1:ribbons] 'shapes.dat' index k-1+at_rest using (ribbon_x(r)*length):(ribbon_y(r)*length) \
         with lines lw 2 lc rgb colour(1) notitle
}
unset multiplot
