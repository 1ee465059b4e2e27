# What curves of held states share: of three keys the first has a line style, `alike` curves each, the second a colour.
right = |list_key| > 1 ? 0.76 : 0.96
load 'over_key.gp'
set xrange [0:*]
set yrange [*<0:*]
set offsets 0, graph 0.03, graph 0.05, 0
dash(k) = (k - 1)/alike % 5 + 1
mark(k) = (k - 1)/alike % 2 ? 6 : 7
shade_of(k) = shade(alike > 1 ? ((k - 1) % alike)/(alike - 1.0) : 0.3)
