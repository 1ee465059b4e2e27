# Derivatives of a run: by how many percent output[k] changes where a key changes by one.
title = 'What counts: percent of the outputs per percent of a key'
load 'functions.gp'
letters = 0
do for [k=1:|output|] { letters = max(letters, strlen(output[k])) }
load 'of_keys.gp'
set xlabel 'change of an output for 1 % of the key / %'
set yzeroaxis lt 1 lw 1 lc rgb '#555555'
set autoscale x
set offsets graph 0.03, graph 0.03, 0, 0
high = 0.8/|output|
top(k) = 0.4 - high*(k - 1)
plot for [k=1:|output|] 'tornado.dat' index k-1 using (0):1:(0):2:($1+top(k)-0.9*high):($1+top(k)) \
     with boxxyerror fc rgb colour(k) fs solid solid(k) border lc rgb colour(k) title output[k]
