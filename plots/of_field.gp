# A part of the field: colours for its strength, lines of potential, metal and the insulators' faces. Indices of `data`:
# 0 a matrix of field strengths, 1 the potential on the grid, 2 and 3 the metals, 4 and 5 the insulators' faces.
load 'functions.gp'
steps = 20 # of potential between the electrodes
apart = drive_voltage/steps
foot = "grey: metal; blue: the insulators' faces; x and y have different scales"
remark = sprintf('black: potential, lines %.4g %s apart', apart*scale(apart, 'V'), unit(apart, 'V'))
right = 0.79
load 'style.gp'
length = scale(box_right, 'm')
field = scale(strongest, 'V/m')
set palette defined (0 '#ffffff', 0.25 '#fee599', 0.5 '#fdb55f', 0.75 '#f2703f', 1 '#c81e3c')
if (decades) set logscale cb
set cbrange [weakest*field:strongest*field]
set cblabel label('field strength', unit(strongest, 'V/m')) offset 0.5
# standalone: the picture is in the file, not beside it; the lines are drawn twice, first into a table
set terminal svg size 600,height dynamic standalone enhanced font 'Helvetica,13' background '#ffffff'
set contour base
unset surface
set cntrparam levels incremental -drive_voltage/2 + apart,apart,drive_voltage/2 - 0.5*apart
set table $lines
splot data index 1 using ($1*length):($2*length):3 with lines nosurface
unset table
unset grid
unset key
set tics front out
set xrange [box_left*length:box_right*length]
set yrange [box_bottom*length:box_top*length]
set xlabel label('x from the clip', unit(box_right, 'm')) offset 0,0.5
set ylabel label('y', unit(box_right, 'm')) offset 0.5
dx = (box_right - box_left)/pixels_across*length
dy = (box_top - box_bottom)/pixels_up*length
plot data index 0 matrix using (box_left*length+(0.5+$1)*dx):(box_bottom*length+(0.5+$2)*dy):($3*field) with image, \
     $lines using 1:2 with lines lw 0.6 lc rgb '#303030', \
     for [k=4:5] data index k using ($1*length):($2*length) with lines lw 1.6 lc rgb '#0060c0', \
     for [k=2:3] data index k using ($1*length):($2*length) with filledcurves closed fc rgb '#8c8c8c'
