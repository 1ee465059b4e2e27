# What curves of held states share.
load 'over_key.gp'
set xrange [0:*]
set yrange [*<0:*]
set offsets 0, graph 0.03, graph 0.05, 0
