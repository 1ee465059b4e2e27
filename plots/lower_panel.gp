# The lower of two panels, over `xlabel`. Title and small print belong to both and have been drawn.
unset label
set tmargin at screen middle - 0.025
set bmargin at screen bottom
set key at screen right + 0.015, middle - 0.025
set format x '%g'
set xlabel xlabel
