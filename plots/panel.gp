# Panel k of grid.gp.
if (k > 1) { unset label; unset key }
set tmargin at screen at(panel_top(k))
set bmargin at screen at(panel_top(k) + 156)
set lmargin at screen panel_left(k)
set rmargin at screen panel_right(k)
