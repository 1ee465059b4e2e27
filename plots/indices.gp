# Which share of the variance of an answer follows from which key: by itself, and with its interactions.
what = exists('quantity') ? quantity : 'force'
if (exists('number_name') && number_name[1] ne '') what = number_name[1].' '.what
title = 'What the scatter of the '.what.' follows from'
letters = 17
load 'of_keys.gp'
set xlabel 'share of the variance / %'
set xrange [*<0:100<*]
plot 'indices.dat' index 0 using (0):1:(0):2:($1+0.02):($1+0.38) with boxxyerror fc rgb colour(1) fs solid solid(1) border lc rgb colour(1) title 'by itself', \
     'indices.dat' index 1 using (0):1:(0):2:($1-0.38):($1-0.02) with boxxyerror fc rgb colour(2) fs solid solid(2) border lc rgb colour(2) title 'with interactions', \
     'indices.dat' index 0 using 2:($1+0.2):3:4 with xerrorbars pt 0 ps 0 lw 1.5 lc rgb '#333333' notitle, \
     'indices.dat' index 1 using 2:($1-0.2):3:4 with xerrorbars pt 0 ps 0 lw 1.5 lc rgb '#333333' title '95 % interval'
