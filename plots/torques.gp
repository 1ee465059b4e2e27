#picture torques.svg many held_branch angle_rad torque_N_m :axis
# Torque of a held fold against its angle.
title = 'Torque of the held fold'
numbers = 'torque_N_m'
load 'held_curves.gp'
factor = scale(largest('torque_N_m'), 'N m')
set xlabel 'angle / degree'
set ylabel label('torque', unit(largest('torque_N_m'), 'N m')) offset 0.5
plot for [k=1:|curve|] '../table.csv' every ::first[k]::last[k] using (column('angle_rad')*180/pi):(column('torque_N_m')*factor) \
     with linespoints lw 2 dt dash(k) pt mark(k) ps 0.7 lc rgb shade_of(k) title curve[k]
