# The shapes of a run, or of the states of rest along the voltage (`path`), as a film. x counts from the middle of the
# actuator; frame i shows now[i], potential[i], contraction[i], stroke[i], and its load hangs at end_x[i], end_y[i].
load 'functions.gp'
set encoding utf8
set terminal gif animate delay delay loop 0 size 640,480 noenhanced background '#ffffff'
set output out
unset key
set grid lc rgb '#dddddd' lw 1 lt 1
set border lc rgb '#333333'
set tics nomirror
set size ratio -1
set tmargin 5
set bmargin 5

length = scale(reach, 'm')
length_unit = unit(reach, 'm')
time = scale(end, 's')
time_unit = unit(end, 's')
voltage = scale(drive_voltage, 'V')
voltage_unit = unit(drive_voltage, 'V')
u = 0.1*reach*length # a length to size clip, load and margins with
platform = platform_length/2*length
set xlabel 'x / '.length_unit
set ylabel 'y / '.length_unit
set xrange [-reach*length - 1.8*u:reach*length + 1.8*u]
set yrange [box_bottom*length - 3*u:box_top*length + 1.2*u]

# how the time of the film goes
slower = delay/100*(frames - 1)/(end - begin)
pace = path ? 'states of rest one after the other, stable or not' : 'still picture'
if (!path && slower >= 1) { pace = sprintf('slow motion, %.3g times slower than real', slower) }
if (!path && slower < 1) { pace = sprintf('fast motion, %.3g times faster than real', 1/slower) }
set label 2 subtitle at screen 0.5,0.91 center
set label 3 pace at screen 0.5,0.865 center
if (!path) set label 4 note at screen 0.5,0.025 center font ',10' tc rgb '#555555'

# holder and clip, which stay where they are, or a wall
if (has_platform) {
  set object 1 rectangle from -platform,0 to platform,0.35*u fc rgb '#555555' fs solid noborder
  set arrow 1 from 0,0.35*u to 0,graph 1 nohead lw 3 lc rgb '#555555'
} else {
  set object 1 rectangle from clamp*length - 0.35*u,-u to clamp*length,u fc rgb '#555555' fs solid noborder
}
if (bath) {
  set object 4 rectangle from graph 0,0 to graph 1,1 behind fc rgb '#e2f1fa' fs solid noborder
  set label 6 'liquid' at graph 0.02,0.07 front
}

do for [k=1:frames + hold] {
  i = k > frames ? frames : k
  # what the caption says
  if (path) {
    caption = sprintf('%.2f %s', potential[i]*voltage, voltage_unit)
    if (!held) { caption = caption.sprintf('    stroke %.2f %s', stroke[i]*length, length_unit) }
  } else {
    caption = sprintf('t = %.1f %s', now[i]*time, time_unit)
    if (contracts && contraction[i] == contraction[i]) { caption = caption.sprintf('    contraction %.0f %%', contraction[i]*100) }
    if (!contracts && strokes && stroke[i] == stroke[i]) { caption = caption.sprintf('    stroke %.2f %s', stroke[i]*length, length_unit) }
    if (ribbons > 1) { caption = caption.sprintf('    %.4g kV', potential[i]/1000.0) }
  }
  set label 1 caption at screen 0.5,0.96 center
  # the platform, and the string with the load on it
  h = has_platform ? 0 : (end_x[i] - middle)*length
  v = end_y[i]*length
  if (has_platform) { set object 2 rectangle from -platform,v-0.35*u to platform,v fc rgb '#555555' fs solid noborder }
  if (held) { set arrow 2 from h,v to h,graph 0 nohead lw 3 lc rgb '#555555' }
  if (!held && load_mass > 0) {
    set arrow 2 from h,v to h,v-u nohead lw 2 lc rgb '#555555'
    set object 3 rectangle from h-1.2*u,v-2.6*u to h+1.2*u,v-u fc rgb '#e69f00' fs solid noborder
    set label 5 load at h,v-1.8*u center front
  }
  # ribbons over their beads
  shapes = bead ? 2*i - 2 : i - 1
  if (bead) {
    set key bottom left samplen 1.5
    plot 'animation.dat' index 2*i-1 using ($1*length):($2*length):($3*length) with filledcurves fc rgb '#56b4e9' title 'liquid', \
         '' index shapes using ($1*length):($2*length) with lines lw 2 lc rgb colour(1) notitle, \
         '' index shapes using ($3*length):($4*length) with lines lw 2 lc rgb colour(2) notitle, \
         '' index shapes every platform_point using ($3*length):($4*length) with points pt 5 ps 1.5 lc rgb '#555555' notitle
  }
  if (!bead && ribbons > 1) {
    plot 'animation.dat' index shapes using ($1*length):($2*length) with lines lw 2 lc rgb colour(1) notitle, \
         '' index shapes using ($3*length):($4*length) with lines lw 2 lc rgb colour(2) notitle, \
         '' index shapes every platform_point using ($3*length):($4*length) with points pt 5 ps 1.5 lc rgb '#555555' notitle
  }
  if (ribbons == 1) {
    plot 'animation.dat' index shapes using ($1*length):($2*length) with lines lw 2 lc rgb colour(1) notitle
  }
}
