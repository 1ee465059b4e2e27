# Modes about the loaded equilibrium, in rows of three panels; `frequency` has one entry for each.
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
  if (lowest) { set xlabel label('x', length_unit) } else { unset xlabel }
  if (first) { set ylabel label('y', length_unit) offset 0.5 } else { unset ylabel }
  if (at_rest) {
    plot 'modes.dat' index 0 using ($1*length):($2*length) with lines lw 1.5 lc rgb '#999999' notitle, \
         'modes.dat' index k using ($1*length):($2*length) with lines lw 2 lc rgb colour(1) notitle
  } else {
    plot 'modes.dat' index k-1 using ($1*length):($2*length) with lines lw 2 lc rgb colour(1) notitle
  }
}
unset multiplot
