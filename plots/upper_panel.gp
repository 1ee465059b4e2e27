# The upper of two panels.
set multiplot
middle = (bottom + top)/2
y_tics = 5
set bmargin at screen middle + 0.025
set format x ''
unset xlabel
