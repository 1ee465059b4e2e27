# Force on the held platform, or on a ribbon of a given shape, against the list key that varies fastest. Of three keys
# the first has a line style, `alike` curves each, the second a colour.
title = held ? 'Force on the held platform' : 'Electric force on a ribbon of one half'
right = many ? 0.76 : 0.96
load 'style.gp'
if (many) set key title legend left font ',12'
factor = scale(largest_force_N, 'N')
set xlabel x_label
set ylabel label('force', unit(largest_force_N, 'N')) offset 0.5
set xrange [0:*]
set yrange [*<0:*]
set offsets 0, graph 0.03, graph 0.05, 0
dash(k) = (k - 1)/alike % 5 + 1
mark(k) = (k - 1)/alike % 2 ? 6 : 7
shade_of(k) = shade(alike > 1 ? ((k - 1) % alike)/(alike - 1.0) : 0.3)
plot for [k=1:|curve|] 'forces.dat' index k-1 using ($1*x_factor):($2*factor) \
     with linespoints lw 2 dt dash(k) pt mark(k) ps 0.6 lc rgb shade_of(k) title curve[k]
