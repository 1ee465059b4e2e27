# zipact reproduce: shapes at rest under the loads of the paper's fig. 6, load[k] in g. For each an index of the .dat of
# the finite elements, then one of the chain.
title = 'Shapes at rest under six loads'
subtitle = '100 µm steel, K\_S calibrated at 61 g'
letters = 15
load 'style.gp'
set xlabel 'x from the clip / mm'
set ylabel 'y / mm' offset 0.5
set xrange [0:46]
plot for [i=1:|load|] 'fig-6.dat' index 2*i-2 using ($1*1e3):($2*1e3) with lines lw 2 dt dash(i) lc rgb colour(i) title sprintf('%g g', load[i]), \
     for [i=1:|load|] '' index 2*i-1 every 3 using ($1*1e3):($2*1e3) with points pt 7 ps 0.5 lc rgb colour(i) notitle, \
     NaN with lines lw 2 lc rgb '#555555' title 'finite elements', \
     NaN with points pt 7 ps 0.5 lc rgb '#555555' title 'chain, N = 61'
