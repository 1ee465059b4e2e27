# zipact reproduce: force along a ribbon, by the field, by the plates law and as the paper's program has it.
title = 'Electric force along a ribbon'
subtitle = 'opening 2 mm, 5 kV, one Bézier curve, no breakdown'
letters = 19
load 'style.gp'
set xlabel 'x from the clip / mm'
set ylabel 'force / (N/m)' offset 0.5
set xrange [0:45]
set yrange [0:*]
plot 'fig-7.dat' index 0 using ($1*1e3):2 with lines lw 5 lc rgb '#56b4e9' title 'field', \
     '' index 1 using ($1*1e3):2 with lines lw 1.5 dt 2 lc rgb '#000000' title 'plates law', \
     '' index 2 using ($1*1e3):2 with lines lw 2 lc rgb '#d55e00' title "the paper's plates", \
     '' index 2 using ($1*1e3):($2*factor) with lines lw 2 dt 4 lc rgb '#d55e00' title sprintf('the same times %.2f', factor)
