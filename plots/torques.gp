# Torque of a held fold against its angle.
title = 'Torque of the held fold'
load 'held_curves.gp'
factor = scale(largest_value, 'N m')
set xlabel 'angle / degree'
set ylabel label('torque', unit(largest_value, 'N m')) offset 0.5
plot for [k=1:|curve|] 'torques.dat' index k-1 using ($2*180/pi):($3*factor) \
     with linespoints lw 2 dt dash(k) pt mark(k) ps 0.6 lc rgb shade_of(k) title curve[k]
