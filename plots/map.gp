# What a study answers over two list keys, as colours with contours and their values on them.
data = 'map.dat'
tics_most = 9
contours = 8
load 'of_maps.gp'
splot 'map.dat' index 0 using ($1*x_factor):($2*y_factor):($3*factor) with pm3d nocontour, \
      'map.dat' index 0 using ($1*x_factor):($2*y_factor):($3*factor) with lines lw 1.2 lc rgb '#ffffff' nosurface, \
      'map.dat' index 0 using ($1*x_factor):($2*y_factor):($3*factor) with labels tc rgb '#ffffff' nosurface
