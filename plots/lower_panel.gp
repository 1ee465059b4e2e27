# The lower of two panels, over `xlabel`. Title and small print belong to both and have been drawn.
unset label
set tmargin at screen 0.505
set bmargin at screen 0.17
set key at screen right + 0.015, 0.505
set format x '%g'
set xlabel xlabel
