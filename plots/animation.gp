#picture animation.gif one motion time_s @output.animation :shapes.dat !:bodies
#picture animation.gif one branch|held_branch voltage_V @output.animation :shapes.dat +drive.voltage !:bodies
# The shapes of a run, or of the states of rest along the voltage (`path`), as a film. x counts from the middle of the
# actuator; frame i is at frame_time[i] and frame_voltage[i], and its load hangs at end_x[i], end_y[i].
load 'of_box.gp'
load 'one_voltage.gp'
load 'subtitle.gp'
load 'wet.gp'
most = 80
load 'snapshots.gp'
shown_frames = words(snapshots)
load 'note.gp'
note = foot
path = kind ne 'motion'
held = kind eq 'held_branch'
has_platform = actuator_kind eq 'electro_ribbon'
bath = !hanging && !path && liquid eq 'submerged' && has('film_thickness_m')
field_known = members == 1 || liquid ne 'bead'
last_node = nodes*members - 1
load_node = has_platform && !half ? (last_node + 1)/2 - 1 : last_node
array end_x[frames]
array end_y[frames]
array clip_x[frames]
array clip_y[frames]
_load(f) = column(4) == load_node ? (end_x[f] = ribbon_x(ribbons), end_y[f] = ribbon_y(ribbons)) : 0
_clip(f) = column(4) == 0 ? (clip_x[f] = ribbon_x(1), clip_y[f] = ribbon_y(1)) : 0
stats 'shapes.dat' using (column(1) == column(1) ? (_load(int(column(1)) + 1), _clip(int(column(1)) + 1)) : 0, 1) nooutput
middle = has_platform ? end_x[1] + platform_length/2 : (box_left + box_right)/2
reach = max(middle - box_left, box_right - middle)
if (hanging) { reach = max(reach, 0.55*(box_top - box_bottom)) }
clamp = clip_x[1] - middle
array contraction_at[frames]
array stroke_at[frames]
do for [i=1:frames] {
  contraction_at[i] = NaN
  stroke_at[i] = hanging ? pouch_count*(end_y[i] - end_y[1]) : clip_y[i] - end_y[i]
}
if (!path) {
  load 'at_frames.gp'
  array contraction_row[rows]
  array stroke_row[rows]
  _said(r) = (contraction_row[r] = has('contraction') ? column('contraction') : NaN, stroke_row[r] = has('stroke_m') ? column('stroke_m') : NaN)
  stats '../table.csv' using (_said(int(column(0)) + 1), 1) nooutput
  set datafile separator whitespace
  unset datafile columnheaders
  do for [i=1:frames] {
    contraction_at[i] = contraction_row[row_of[i]]
    stroke_at[i] = stroke_row[row_of[i]]
  }
}
hold = 12 # how often the last frame is repeated
delay = max(2, floor(480.0/shown_frames + 0.5)) # of a frame, hundredths of a second
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
if (hanging && insulator_thickness != insulator_thickness) { insulator_thickness = ribbon_thickness } # auto
insulator_offset = given ? electro_insulator_offset : 2*insulator_thickness*medium_permittivity/insulator_permittivity
stopped = actuator_kind eq 'plate' ? plate_stop_gap : 0 # a gap that never closes
strongest = electro_breakdown_cap > 0 ? medium_breakdown_field : drive_voltage/(2*insulator_thickness + stopped)
limit(E) = electro_breakdown_cap > 0 && E > strongest ? strongest : E
between(gap, volts) = limit(abs(volts)/((gap > 0 ? gap : 0) + insulator_offset))
share(E) = E >= strongest ? 1 : sqrt(E/strongest)
_of(p) = p < 1 ? int(4*p) : 3
_blend(l, p, k) = floor(word(l, k + 1) + (4*p - k)*(word(l, k + 2) - word(l, k + 1)) + 0.5)
field_colour(p) = 65536*_blend('223 142 244 239 181', p, _of(p)) + 256*_blend('238 202 201 123 23', p, _of(p)) \
                + _blend('240 208 93 69 158', p, _of(p))
shown(gap, volts) = field_colour(share(between(gap, volts)))
volts_at(node) = hanging && node > electrode_end ? 0 : volts
coloured = ribbons > 1 && insulator_offset + stopped > 0 && field_known
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

# Bars of liquid, 5 pixels wide, so many for each element that no gaps are left. A row of shapes.dat has x and y of both
# faces; bar q, from 0 to 1, is on the way from the row before to this one. Side 1 is the mirror image of side 0.
columns_drawn = half || nodes == 2 ? nodes : nodes/2
parts = (60 + columns_drawn - 2)/(columns_drawn - 1)
side_x(side, x) = (side == 1 ? middle - x : x - middle)*length
_is_wet(p) = (half || p <= last_node/2.0 ? p : last_node - p) <= wet_at[i]
_between(was, now) = was + q*(now - was)
_bar(j) = (q = j == 0 ? 1.0 : j/(1.0*parts), p = column(4) - 1 + q, xu = _between(xu_was, column(5)), yu = _between(yu_was, column(6)), \
           xl = _between(xl_was, column(7)), yl = _between(yl_was, column(8)), \
           xu_was = column(5), yu_was = column(6), xl_was = column(7), yl_was = column(8), \
           j > 0 && node(0) % nodes == 0 ? NaN : _is_wet(p) ? xu : NaN)
xu_was = 0; yu_was = 0; xl_was = 0; yl_was = 0
node(c) = column(4) == column(4) ? int(column(4)) : -1
is_clip(k) = !hanging && nodes > 2 && (k % nodes == 0 || (!half && k % nodes == nodes - 1))

lensed = coloured && has_platform && members == 1
lens_size = 0.17
thick = insulator_thickness + ribbon_thickness
set object 4 rectangle from graph 0,0 to graph 1,1 behind fc rgb (bath ? '#edf3f0' : '#ffffff') fs solid noborder
if (bath) set label 6 'in a bath of liquid' at screen 0.97,0.835 right front font ',11' tc rgb '#555555'
if (lensed) set label 7 sprintf('zip front, %.0f times larger', magnified) at screen 0.05,0.08 front font ',11' tc rgb '#555555'
open_at(x, gap) = x < 0 && gap > insulator_thickness ? x : -platform_length/2

# how the time of the film goes
slower = delay/100.0*(shown_frames - 1)/(end - begin)
pace = path ? 'equilibria one after the other, stable or not' : 'still picture'
if (!path && slower >= 1) { pace = sprintf('slow motion, %.3g times slower than real', slower) }
if (!path && slower < 1) { pace = sprintf('fast motion, %.3g times faster than real', 1/slower) }
set label 2 subtitle at screen 0.5,0.925 center
set label 3 pace at screen 0.5,0.885 center
if (!path && !coloured) set label 4 note at screen 0.5,0.025 center font ',11' tc rgb '#555555'

load 'stage.gp'

# holder and clip, which stay where they are, or a wall
if (has_platform || hanging) {
  holder = has_platform ? platform : 0.6*u
  set object 1 rectangle from -holder,0 to holder,0.35*u fc rgb '#555555' fs solid noborder
  set arrow 1 from 0,0.35*u to 0,graph 1 nohead lw 3 lc rgb '#555555'
} else {
  set object 1 rectangle from clamp*length - 0.35*u,-u to clamp*length,u fc rgb '#555555' fs solid noborder
}

do for [k=1:shown_frames + hold] {
  i = word(snapshots, min(k, shown_frames)) + 0
  # what the caption says
  if (path) {
    caption = sprintf('%.2f %s', frame_voltage[i]*voltage, voltage_unit)
    if (!held) { caption = caption.sprintf('    stroke %.2f %s', stroke_at[i]*length, length_unit) }
  } else {
    caption = sprintf('t = %.1f %s', frame_time[i]*time, time_unit)
    if (!hanging && has('contraction') && contraction_at[i] == contraction_at[i]) { caption = caption.sprintf('    contraction %.0f %%', abs(contraction_at[i]) < 0.005 ? 0 : contraction_at[i]*100) }
    if ((hanging || !has('contraction')) && has('stroke_m') && stroke_at[i] == stroke_at[i]) { caption = caption.sprintf('    stroke %.2f %s', stroke_at[i]*length, length_unit) }
    if (ribbons > 1 && one_voltage) { caption = caption.sprintf('    %.4g kV', frame_voltage[i]/1000.0) }
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
    if (members == 1 && !hanging) { set label 5 said(said_load_mass) at h,v-1.8*u center front tc rgb '#ffffff' }
    if (members > 1 || hanging) { set label 5 said(said_load_mass) at h+1.6*u,v-1.8*u left front tc rgb '#37434d' }
  }
  # what is between the faces, coloured by the field, then the ribbons over it
  volts = frame_voltage[i]
  if (coloured && has_platform && members == 1 && !bead) {
    set object 5 rectangle from -platform,v to platform,0 back fc rgb (platform_electrode > 0 ? shown(-end_y[i], volts) : field_colour(0)) fs solid noborder
  }
  if (lensed) { set multiplot }
  plot for [side=0:half] for [j=0:(ribbons > 1 ? parts-1 : -1)] 'shapes.dat' index i-1 \
         using (bar = _bar(j), side_x(side, drawn_x(bar, yu))):(drawn_y(bar, yu)*length):(drawn_x(side == 1 ? xu - xl : xl - xu, yl - yu)*length):(drawn_y(xl - xu, yl - yu)*length):(coloured ? shown(yu - yl, volts_at(p)) : 0xe2f1fa) \
         with vectors nohead lw 5 lc rgb variable notitle, \
       for [c=1:counter] 'shapes.dat' index i-1 using (side_x(0, counter_x($4))):(counter_face(counter_x($4))*length) \
         with lines lw 5 lc rgb '#aaaaaa' notitle, \
       for [side=0:half] for [r=1:ribbons] 'shapes.dat' index i-1 using (side_x(side, ribbon_x(r))):(ribbon_y(r)*length) \
         with lines lw 2 lc rgb (hanging ? tape : metal) notitle, \
       for [r=1:hanging*ribbons] 'shapes.dat' index i-1 using (side_x(0, ribbon_x(r))):(electrode_y(r)*length) \
         with lines lw 4 lc rgb metal notitle, \
       for [side=0:(ribbons > 1 ? half : -1)] 'shapes.dat' index i-1 using (is_clip(node(0)) ? side_x(side, $7) : NaN):($8*length) \
         with points pt 5 ps (members > 8 ? 0.7 : 1.5) lc rgb metal notitle
  if (lensed) {
    stats 'shapes.dat' index i-1 using (open_at($5 - middle, $6 - $8)) name 'gap' nooutput
    front = gap_min
    level = end_y[i]/2
    if (front < -platform_length/2 - 1e-9) {
      stats 'shapes.dat' index i-1 using ($5 - middle == front ? ($6 + $8)/2 : NaN) name 'level' nooutput
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
    lens_x(x) = (half && column(4) == last_node ? middle - x : x - middle)*length
    plot 'shapes.dat' index i-1 using (_is_wet(column(4)) ? lens_x($5) : NaN):($6*length):($8*length) with filledcurves fc rgb shown(insulator_thickness, volts) notitle, \
         '' index i-1 using (lens_x($5)):($6*length):(($6 + insulator_thickness)*length) with filledcurves fc rgb tape notitle, \
         '' index i-1 using (lens_x($5)):(($6 + insulator_thickness)*length):(($6 + thick)*length) with filledcurves fc rgb metal notitle, \
         '' index i-1 using (lens_x($7)):($8*length):(($8 - insulator_thickness)*length) with filledcurves fc rgb tape notitle, \
         '' index i-1 using (lens_x($7)):(($8 - insulator_thickness)*length):(($8 - thick)*length) with filledcurves fc rgb metal notitle
    unset multiplot
    load 'stage.gp'
  }
}
