#picture maps.svg many actuate zip_time_s*9 :planes
#picture maps.svg many stationary stroke_m*9 :planes
#picture maps.svg many equilibrium pull_in_voltage_V*9 :planes
#picture maps.svg many modes frequency_1_Hz*9 :planes
#picture maps.svg many isometric force_N*9 :planes
#picture maps.svg many profile scale_factor*9 :planes
#picture maps.svg many limits max_load_kg*9 :planes
#picture maps.svg many cycle opening_max_m*9 :planes
# The same over three keys: a map for each value panel_at[k] of the third, with axes named once.
of_three = 1
contours = 6
load 'of_maps.gp'
subtitle = subtitle.(subtitle eq '' ? '' : ', ').'panels: '.name_of(z_key)
set label 2 subtitle
set tics font ',11' scale 0.4
set label 6 y_label at screen 0.03, (bottom + 0.81)/2 center rotate
set label 7 x_label at screen (left + right)/2, bottom - 0.1 center
unset xlabel
unset ylabel
across = |panel_at| <= 4 ? 2 : 3
down = (|panel_at| + across - 1)/across
panel_width = (right + 0.02 - left)/across
panel_height = (top - bottom)/down
set multiplot
do for [k=1:|panel_at|] {
  panel_left = left + panel_width*((k - 1) % across)
  panel_top = top - panel_height*((k - 1)/across)
  panel = k - 1
  map_left = panel_left
  map_bottom = panel_top - panel_height + 0.005
  map_width = 600*(panel_width - 0.02)
  map_height = height*(panel_height - 0.055)
  load 'contour_labels.gp'
  set lmargin at screen panel_left
  set rmargin at screen panel_left + panel_width - 0.02
  set tmargin at screen panel_top - 0.05
  set bmargin at screen map_bottom
  set label 5 sprintf('%.4g %s', panel_at[k]*of('factor_', z_key), unit_of(z_key)) at screen panel_left + panel_width/2, panel_top - 0.03 center font ',11'
  lowest = k + across > |panel_at|
  first = (k - 1) % across == 0
  set format x (lowest ? '%g' : '')
  set format y (first ? '%g' : '')
  if (k > 1) { unset colorbox }
  splot $map index k-1 using ($1*x_factor):($2*y_factor):($3*factor) with pm3d nocontour, \
        '' index k-1 using ($1*x_factor):($2*y_factor):($3*factor) with lines lw 2.4 lc rgb '#ffffff' nosurface, \
        '' index k-1 using ($1*x_factor):($2*y_factor):($3*factor) with lines lw 0.8 lc rgb '#000000' nosurface
  unset label
}
unset multiplot
