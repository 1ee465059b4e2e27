# The look of all pictures: paper, fonts, frame, title and small print. They are to be read on a phone, 390 px wide, where
# letters have two thirds of their size. A template sets first
#   title          what the picture shows
#   letters        those of the longest text of the legend, which is to the right of the axes; or, without a legend,
#   right          right edge of the axes, as a part of the width
#   left           left edge of its axes, where it is not 0.14
#   height         of the picture in pixels, where it is not 420
#   shapes         if x and y have the same scale: the axes are as high as the shapes need, and at least this many pixels
#   foot, remark   lines of small print, where there are any
#   subtitle       under which load, voltage and so on, where subtitle.gp does not say it
load 'functions.gp'
load 'subtitle.gp'
if (!exists('right')) right = beside(letters)
if (!exists('left')) left = 0.14
if (!exists('height')) height = 420
if (!exists('foot')) foot = ''
if (!exists('remark')) remark = ''
print_lines = (foot ne '') + (remark ne '')
if (exists('shapes')) height = min(420, 124 + 19*print_lines + max(shapes, ceil(600*(right - left)*shape_ratio)))
px(n) = n/(1.0*height)
top = 1 - px(58.8)
bottom = px(65.1 + 18.9*print_lines)
set encoding utf8
set terminal svg size 600,height dynamic enhanced font 'Helvetica,13' background '#ffffff'
set output out
set dashtype 6 (14,3)
set dashtype 7 (14,3,2,3)
set dashtype 8 (6,2,2,2,2,2)
set grid lc rgb '#dddddd' lw 1 lt 1
set border lc rgb '#333333'
set tics nomirror
set lmargin at screen left
set rmargin at screen right
set bmargin at screen bottom
set tmargin at screen top
set key at screen right + 0.015, top left top Left reverse samplen 3 spacing 1.2 font ',12'
set colorbox user origin right + 0.025, bottom size 0.025, top - bottom
set label 1 title at screen 0.025, 1 - px(18.9) left font ',16'
set label 2 subtitle at screen 0.025, 1 - px(39.9) left font ',12' tc rgb '#555555'
set label 3 foot.(print_lines == 2 ? "\n" : '').remark at screen 0.025, px(18.9*print_lines - 6.3) left font ',11' tc rgb '#555555'
