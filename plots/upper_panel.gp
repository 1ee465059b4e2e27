# The upper of two panels.
set multiplot
set bmargin at screen 0.555
set format x ''
unset xlabel
