# Force on what is held, or on a ribbon of a given shape, against the list key that varies fastest.
title = !held ? 'Electric force on a ribbon of one half' \
      : actuator_kind eq 'hinge' ? 'Force on the held end' : 'Force on the held platform'
load 'held_curves.gp'
factor = scale(largest_value, 'N')
set xlabel x_label
set ylabel label('force', unit(largest_value, 'N')) offset 0.5
plot for [k=1:|curve|] 'forces.dat' index k-1 using ($1*x_factor):($2*factor) \
     with linespoints lw 2 dt dash(k) pt mark(k) ps 0.6 lc rgb shade_of(k) title curve[k]
