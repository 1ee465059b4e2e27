# The shapes of a run, or of the states of rest along the voltage (`path`), as a film. x counts from the middle of the
# actuator; frame i shows now[i], potential[i], contraction[i], stroke[i], and its load hangs at end_x[i], end_y[i].
load 'functions.gp'
hold = 12 # how often the last frame is repeated
delay = max(2, floor(480.0/frames + 0.5)) # of a frame, hundredths of a second
if (delay > 40) delay = 40
set encoding utf8
set terminal gif animate delay delay loop 0 size 640,480 noenhanced font ',13' background '#ffffff'
set output out
unset key
set grid lc rgb '#dddddd' lw 1 lt 1

length = scale(reach, 'm')
length_unit = unit(reach, 'm')
time = scale(end, 's')
time_unit = unit(end, 's')
voltage = scale(drive_voltage, 'V')
voltage_unit = unit(drive_voltage, 'V')
u = 0.1*reach*length # a length to size clip, load and margins with
platform = platform_length/2*length

# the field between the faces by the plates law, V/m, and its colour: by the square root, so that weak fields show, too;
# where beads of several actuators end is not known here, so neither is the field
metal = '#37434d'
tape = '#c9a66b'
given = electro_insulator_offset == electro_insulator_offset
insulator_offset = given ? electro_insulator_offset : 2*insulator_thickness*medium_permittivity/insulator_permittivity
strongest = electro_breakdown_cap > 0 ? medium_breakdown_field : drive_voltage/(2*insulator_thickness)
limit(E) = electro_breakdown_cap > 0 && E > strongest ? strongest : E
between(gap, volts) = limit(abs(volts)/((gap > 0 ? gap : 0) + insulator_offset))
share(E) = E >= strongest ? 1 : sqrt(E/strongest)
_of(p) = p < 1 ? int(4*p) : 3
_blend(l, p, k) = floor(word(l, k + 1) + (4*p - k)*(word(l, k + 2) - word(l, k + 1)) + 0.5)
field_colour(p) = 65536*_blend('223 142 244 239 181', p, _of(p)) + 256*_blend('238 202 201 123 23', p, _of(p)) \
                + _blend('240 208 93 69 158', p, _of(p))
shown(gap, volts) = field_colour(share(between(gap, volts)))
coloured = ribbons > 1 && insulator_offset > 0 && field_known
if (coloured) {
  do for [k=0:19] {
    set object 20+k rectangle from screen 0.70+0.012*k,0.08 to screen 0.712+0.012*k,0.095 fc rgb field_colour(k/19.0) fs solid noborder
  }
  set label 20 '0' at screen 0.70,0.06 font ',11' tc rgb '#555555'
  set label 21 sprintf('%.3g', strongest/4e6) at screen 0.82,0.06 center font ',11' tc rgb '#555555'
  set label 22 sprintf('%.3g MV/m', strongest/1e6) at screen 0.94,0.06 center font ',11' tc rgb '#555555'
  set label 4 note at screen 0.02,0.022 left font ',11' tc rgb '#555555'
}

# The lens shows the front of the left half, so many times larger: where, from the clip on, the gap is as thick as an
# insulator.
magnified = 25

# A block of liquid has its lower face in column `low`, straight below; one of shapes has x and y of the lower station.
low = bead ? 3 : 4
aside(x) = bead ? 0 : column(3) - x

lensed = coloured && has_platform && members == 1
lens_size = 0.17
thick = insulator_thickness + ribbon_thickness
set object 4 rectangle from graph 0,0 to graph 1,1 behind fc rgb (bath ? '#edf3f0' : '#ffffff') fs solid noborder
if (bath) set label 6 'in a bath of liquid' at screen 0.97,0.835 right front font ',11' tc rgb '#555555'
if (lensed) set label 7 sprintf('zip front, %.0f times larger', magnified) at screen 0.05,0.08 front font ',11' tc rgb '#555555'
open_at(x, gap) = x < 0 && gap > insulator_thickness ? x : -platform_length/2

# how the time of the film goes
slower = delay/100.0*(frames - 1)/(end - begin)
pace = path ? 'equilibria one after the other, stable or not' : 'still picture'
if (!path && slower >= 1) { pace = sprintf('slow motion, %.3g times slower than real', slower) }
if (!path && slower < 1) { pace = sprintf('fast motion, %.3g times faster than real', 1/slower) }
set label 2 subtitle at screen 0.5,0.925 center
set label 3 pace at screen 0.5,0.885 center
if (!path && !coloured) set label 4 note at screen 0.5,0.025 center font ',11' tc rgb '#555555'

load 'stage.gp'

# holder and clip, which stay where they are, or a wall
if (has_platform) {
  set object 1 rectangle from -platform,0 to platform,0.35*u fc rgb '#555555' fs solid noborder
  set arrow 1 from 0,0.35*u to 0,graph 1 nohead lw 3 lc rgb '#555555'
} else {
  set object 1 rectangle from clamp*length - 0.35*u,-u to clamp*length,u fc rgb '#555555' fs solid noborder
}

do for [k=1:frames + hold] {
  i = k > frames ? frames : k
  # what the caption says
  if (path) {
    caption = sprintf('%.2f %s', potential[i]*voltage, voltage_unit)
    if (!held) { caption = caption.sprintf('    stroke %.2f %s', stroke[i]*length, length_unit) }
  } else {
    caption = sprintf('t = %.1f %s', now[i]*time, time_unit)
    if (has('contraction') && contraction[i] == contraction[i]) { caption = caption.sprintf('    contraction %.0f %%', abs(contraction[i]) < 0.005 ? 0 : contraction[i]*100) }
    if (!has('contraction') && has('stroke_m') && stroke[i] == stroke[i]) { caption = caption.sprintf('    stroke %.2f %s', stroke[i]*length, length_unit) }
    if (ribbons > 1) { caption = caption.sprintf('    %.4g kV', potential[i]/1000.0) }
  }
  set label 1 caption at screen 0.5,0.965 center
  # the platform, and the string with the load on it
  h = has_platform ? 0 : (end_x[i] - middle)*length
  v = end_y[i]*length
  if (has_platform) { set object 2 rectangle from -platform,v-0.35*u to platform,v fc rgb '#555555' fs solid noborder }
  if (held) { set arrow 2 from h,v to h,graph 0 nohead lw 3 lc rgb '#555555' }
  if (!held && load_mass > 0) {
    set arrow 2 from h,v to h,v-u nohead lw 2 lc rgb '#555555'
    set object 3 rectangle from h-1.2*u,v-2.6*u to h+1.2*u,v-u fc rgb '#55626d' fs solid noborder
    if (members == 1) { set label 5 load at h,v-1.8*u center front tc rgb '#ffffff' }
    if (members > 1) { set label 5 load at h+1.6*u,v-1.8*u left front tc rgb '#37434d' }
  }
  # what is between the faces, coloured by the field, then the ribbons over it
  shapes = bead ? 2*i - 2 : i - 1
  volts = potential[i]
  liquid = bead ? 2*i - 1 : shapes
  if (coloured && has_platform && members == 1 && !bead) {
    set object 5 rectangle from -platform,v to platform,0 back fc rgb (platform_electrode > 0 ? shown(-end_y[i], volts) : field_colour(0)) fs solid noborder
  }
  if (lensed) { set multiplot }
  if (ribbons > 1) {
    plot 'animation.dat' index liquid using ($1*length):($2*length):(aside($1)*length):((column(low) - $2)*length):(coloured ? shown($2 - column(low), volts) : 0xe2f1fa) \
           with vectors nohead lw 5 lc rgb variable notitle, \
         '' index shapes using ($1*length):($2*length) with lines lw 2 lc rgb metal notitle, \
         '' index shapes using ($3*length):($4*length) with lines lw 2 lc rgb metal notitle, \
         '' index shapes every platform_point using ($3*length):($4*length) with points pt 5 ps 1.5 lc rgb metal notitle
  }
  if (ribbons == 1) {
    plot 'animation.dat' index shapes using ($1*length):($2*length) with lines lw 2 lc rgb metal notitle
  }
  if (lensed) {
    stats 'animation.dat' index shapes using (open_at($1, $2 - $4)) name 'gap' nooutput
    front = gap_min
    level = end_y[i]/2
    if (front < -platform_length/2 - 1e-9) {
      stats 'animation.dat' index shapes using ($1 == front ? ($2 + $4)/2 : NaN) name 'level' nooutput
      level = level_mean
    }
    wide = 2*(reach*length + 1.8*u)*lens_size/magnified
    set size lens_size,lens_size*640/480.0
    set origin 0.05,0.11
    set lmargin 0; set rmargin 0; set tmargin 0; set bmargin 0
    set border lc rgb '#0b6e8a' lw 2
    set format ''
    unset xlabel
    unset ylabel
    unset tics
    set xrange [front*length - wide/2:front*length + wide/2]
    set yrange [level*length - wide/2:level*length + wide/2]
    plot 'animation.dat' index liquid using ($1*length):($2*length):(column(low)*length) with filledcurves fc rgb shown(insulator_thickness, volts) notitle, \
         '' index shapes using ($1*length):($2*length):(($2 + insulator_thickness)*length) with filledcurves fc rgb tape notitle, \
         '' index shapes using ($1*length):(($2 + insulator_thickness)*length):(($2 + thick)*length) with filledcurves fc rgb metal notitle, \
         '' index shapes using ($3*length):($4*length):(($4 - insulator_thickness)*length) with filledcurves fc rgb tape notitle, \
         '' index shapes using ($3*length):(($4 - insulator_thickness)*length):(($4 - thick)*length) with filledcurves fc rgb metal notitle
    unset multiplot
    load 'stage.gp'
  }
}
