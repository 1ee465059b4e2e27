# The look of all pictures: paper, fonts, frame, title and small print. A template sets first
#   title          what the picture shows
#   right          right edge of its axes, as a part of the width; the legend is to the right of it
#   height         of the picture in pixels, where it is not 500
#   foot, remark   small print on the right and on the left, where there is any
# and zipact has set `subtitle`: under which load, voltage and so on.
load 'functions.gp'
set encoding utf8
set terminal svg size 800,(exists('height') ? height : 500) dynamic enhanced font 'Helvetica,14' background '#ffffff'
set output out
set dashtype 6 (14,3)
set dashtype 7 (14,3,2,3)
set dashtype 8 (6,2,2,2,2,2)
set grid lc rgb '#dddddd' lw 1 lt 1
set border lc rgb '#333333'
set tics nomirror
set lmargin at screen 0.11
set rmargin at screen right
set bmargin at screen 0.17
set tmargin at screen 0.86
set key at screen right + 0.015, 0.86 left top Left reverse samplen 3 spacing 1.2 font ',12'
set label 1 title at screen 0.11, 0.955 left font ',17'
set label 2 subtitle at screen 0.11, 0.905 left font ',12' tc rgb '#555555'
if (exists('foot')) set label 3 foot at screen 0.985, 0.025 right font ',10' tc rgb '#555555'
if (exists('remark')) set label 4 remark at screen 0.015, 0.025 left font ',10' tc rgb '#555555'
