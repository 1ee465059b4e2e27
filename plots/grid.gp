# Panels, two in a row if there are several: their number is `panels`. panel.gp begins each.
across = panels > 1 ? 2 : 1
height = 78 + 220*((panels + across - 1)/across) + (exists('foot') && remark ne '' ? 19 : 0)
right = 0.97
load 'style.gp'
at(y) = 1 - y/(1.0*height) # y in pixels from above
panel_top(k) = 74 + 220*((k - 1)/across)
panel_left(k) = across > 1 && k % 2 == 0 ? 0.64 : 0.14
panel_right(k) = across > 1 && k % 2 ? 0.48 : 0.97
tics = across > 1 ? 4 : 7 # at most, along x
set tics font ',11'
set key at screen right, at(4) right top vertical noreverse Right spacing 0.95 maxrows 3
set multiplot
