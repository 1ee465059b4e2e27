#picture map.svg many actuate zip_time_s*9 :plane
#picture map.svg many stationary stroke_m*9 :plane
#picture map.svg many equilibrium pull_in_voltage_V*9 :plane
#picture map.svg many modes frequency_1_Hz*9 :plane
#picture map.svg many isometric force_N*9 :plane
#picture map.svg many profile scale_factor*9 :plane
#picture map.svg many limits max_load_kg*9 :plane
#picture map.svg many cycle opening_max_m*9 :plane
# What a study answers over two list keys, as colours with contours and their values on them.
tics_most = 9
contours = 8
load 'of_maps.gp'
panel = 0
map_left = left
map_bottom = bottom
map_width = 600*(right - left)
map_height = height*(top - bottom)
load 'contour_labels.gp'
splot $map index 0 using ($1*x_factor):($2*y_factor):($3*factor) with pm3d nocontour, \
      '' index 0 using ($1*x_factor):($2*y_factor):($3*factor) with lines lw 2.4 lc rgb '#ffffff' nosurface, \
      '' index 0 using ($1*x_factor):($2*y_factor):($3*factor) with lines lw 0.8 lc rgb '#000000' nosurface
