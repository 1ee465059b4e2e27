# The same over three keys: a map for each value panel_at[k] of the third, with axes named at the edges only.
load 'of_maps.gp'
set tics font ',11' scale 0.4
set cbrange [lowest_value*factor:highest_value*factor]
set cntrparam levels auto 4
across = |panel_at| <= 4 ? 2 : 3
down = (|panel_at| + across - 1)/across
panel_width = 0.71/across
panel_height = 0.70/down
set multiplot
do for [k=1:|panel_at|] {
  panel_left = 0.11 + panel_width*((k - 1) % across)
  panel_top = 0.86 - panel_height*((k - 1)/across)
  set lmargin at screen panel_left
  set rmargin at screen panel_left + panel_width - 0.025
  set tmargin at screen panel_top - 0.035
  set bmargin at screen panel_top - panel_height + 0.03
  set label 5 sprintf('%s = %.4g %s', z_name, panel_at[k]*z_factor, z_unit) at graph 0.5, graph 1.08 center font ',11'
  lowest = k + across > |panel_at|
  first = (k - 1) % across == 0
  set format x (lowest ? '%g' : '')
  set format y (first ? '%g' : '')
  if (lowest) { set xlabel x_label font ',11' offset 0,0.5 } else { unset xlabel }
  if (first) { set ylabel y_label font ',11' offset -0.3 } else { unset ylabel }
  if (k == 1) { set colorbox user origin 0.85,0.17 size 0.03,0.69 } else { unset colorbox }
  splot 'maps.dat' index k-1 using ($1*x_factor):($2*y_factor):($3*factor) with pm3d nocontour, \
        'maps.dat' index k-1 using ($1*x_factor):($2*y_factor):($3*factor) with lines lw 1.2 lc rgb '#ffffff' nosurface, \
        'maps.dat' index k-1 using ($1*x_factor):($2*y_factor):($3*factor) with labels tc rgb '#ffffff' nosurface
  unset label 1
  unset label 2
  unset label 3
  unset label 4
}
unset multiplot
