# zipact reproduce: force of a held platform against its separation, with breakdown of the liquid, without, and as the
# paper's text has it.
title = 'Contractile force of a held platform'
subtitle = '6 kV, 50 µm steel'
letters = 16
load 'style.gp'
set xlabel 'separation / mm'
set ylabel 'force / N' offset 0.5
set xrange [0:8]
set yrange [0:*]
plot 'fig-8.dat' index 0 using ($1*1e3):2 with linespoints lw 2 pt 7 lc rgb '#0072b2' title 'with breakdown', \
     '' index 1 using ($1*1e3):2 with linespoints lw 2 pt 6 lc rgb '#009e73' title 'without', \
     '' index 2 using ($1*1e3):2 with linespoints lw 2 dt 2 pt 4 lc rgb '#d55e00' title "the paper's text"
