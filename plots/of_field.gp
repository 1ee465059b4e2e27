# The part of field.dat in the box: colours for its strength, lines of potential, metal and the insulators' faces. The colours
# span `decades`, or all from 0. They are drawn first, as a file of pixels.
steps = 20 # of potential between the electrodes
apart = drive_voltage/steps
foot = "grey: metal; blue: the insulators' faces; x and y have different scales"
remark = sprintf('black: potential, lines %.4g %s apart', apart*scale(apart, 'V'), unit(apart, 'V'))
right = 0.79
load 'style.gp'
length = scale(box_right, 'm')
inside(x, y) = x > box_left && x < box_right && y > box_bottom && y < box_top
stats 'field.dat' using (inside($1, $2) ? max($4, $5) : NaN) name 'field' nooutput
strongest = field_max
weakest = decades > 0 ? strongest*10**-decades : 0
field = scale(strongest, 'V/m')
set palette defined (0 '#ffffff', 0.25 '#fee599', 0.5 '#fdb55f', 0.75 '#f2703f', 1 '#c81e3c')
if (decades > 0) set logscale cb
set cbrange [weakest*field:strongest*field]

# lines are drawn twice, first into a table
set contour base
unset surface
set cntrparam levels incremental -drive_voltage/2 + apart,apart,drive_voltage/2 - 0.5*apart
set table $lines
splot 'field.dat' using ($1*length):($2*length):3 with lines nosurface
unset table
unset contour
set surface

# pixels: the strips between the surfaces, of which the field is smooth; metals are the ground
pixels = (decades > 0 ? 'field' : 'field_tip').'.png'
set terminal png truecolor size 960,600 background '#8c8c8c'
set output pixels
set view map
set xrange [box_left*length:box_right*length]
set yrange [box_bottom*length:box_top*length]
set pm3d interpolate 8,4 noborder
set border 0
unset tics
unset colorbox
unset label
unset grid
unset key
set lmargin at screen 0
set rmargin at screen 1
set bmargin at screen 0
set tmargin at screen 1
from_row(s) = s == 0 ? 0 : surface_at[s]
to_row(s) = s == 6 ? 100000 : surface_at[s + 1]
strength(s) = max(weakest, $7 == s - 1 ? $5 : $4)*field
splot for [s=0:6] 'field.dat' every :::from_row(s)::to_row(s) using ($1*length):($2*length):($6 > 0 || $7 == s ? strength(s) : NaN) with pm3d notitle
set output
unset pm3d

# standalone: the picture is in the file, not beside it
load 'style.gp'
set terminal svg size 600,height dynamic standalone enhanced font 'Helvetica,13' background '#ffffff'
set cblabel label('field strength', unit(strongest, 'V/m')) offset 0.5
set colorbox user origin right + 0.025, bottom size 0.025, top - bottom
unset grid
unset key
set border 31 lc rgb '#333333'
set tics front out nomirror
set cbtics
set xlabel label('x from the clip', unit(box_right, 'm')) offset 0,0.5
set ylabel label('y', unit(box_right, 'm')) offset 0.5
on_face(s, x) = $7 == s && x >= left_x && x <= right_x ? x*length : NaN
plot pixels binary filetype=png origin=(box_left*length,box_bottom*length) dx=(box_right-box_left)*length/960 dy=(box_top-box_bottom)*length/600 with rgbimage notitle, \
     $lines using 1:2 with lines lw 0.6 lc rgb '#303030', \
     for [s=2:3] 'field.dat' every :::surface_at[s+1]::surface_at[s+1] using (on_face(s, $1)):($2*length) with lines lw 1.6 lc rgb '#0060c0', \
     NaN with points palette
