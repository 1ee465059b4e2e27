#picture animation.gif one motion time_s @output.animation :shapes.dat :bodies !:planar
#picture animation.gif one branch|held_branch voltage_V @output.animation :shapes.dat +drive.voltage :bodies !:planar
# The members of a network, each with its platform or its right end at the place of its lower body (bodies.NAME.at), and
# the bodies as bars, as a film.
load 'of_box.gp'
load 'one_voltage.gp'
load 'subtitle.gp'
most = 80
load 'snapshots.gp'
shown_frames = words(snapshots)
path = kind ne 'motion'
if (path) {
  array row_of[frames]
  do for [i=1:frames] { row_of[i] = min(int(frame_time[i]/stride), rows - 1) + 1 }
} else {
  load 'note.gp'
  load 'at_frames.gp'
}

# heights of the bodies in each frame
bodies = words(bodies_named)
array height[bodies*frames]
array height_row[rows]
set datafile separator ','
set datafile columnheaders
do for [b=1:bodies] {
  name = word(bodies_named, b).'.y_m'
  given_y = number(sprintf('body_%d_at_y', b))
  if (has(name)) { stats '../table.csv' using (height_row[int(column(0)) + 1] = column(name), 1) nooutput }
  do for [i=1:frames] { height[(b - 1)*frames + i] = has(name) ? height_row[row_of[i]] : given_y == given_y ? given_y : 0 }
}
set datafile separator whitespace
unset datafile columnheaders

# where members are, and how far bodies reach; body 0 is the frame
node(c) = column(4) == column(4) ? int(column(4)) : -1
member_of(n) = n/nodes + 1
has_platform = actuator_kind eq 'electro_ribbon'
load_node = !has_platform || half ? nodes - 1 : nodes/2 - 1
array middle[members] # of the platform, or the right end
array place_x[members]
_middle(n, x) = n % nodes == load_node ? (middle[member_of(n)] = x + (has_platform ? platform_length/2 : 0)) : 0
stats 'shapes.dat' index 0 using (node(0) < 0 ? 0 : _middle(node(0), ribbon_x(ribbons)), 1) nooutput
array from_x[bodies + 1]
array to_x[bodies + 1]
array holds[bodies] # does a member hang on it?
do for [b=1:bodies+1] { from_x[b] = 1e300; to_x[b] = -1e300 }
do for [b=1:bodies] { holds[b] = 0 }
do for [k=1:members] {
  lower = number(sprintf('member_%d_lower', k))
  upper = number(sprintf('member_%d_upper', k))
  if (upper > 0) { holds[int(upper)] = 1 }
  at_x = number(sprintf('body_%d_at_x', lower))
  place_x[k] = at_x == at_x ? at_x : 0
  do for [b in sprintf('%d %d', lower, upper)] {
    held_x = has_platform || b == lower ? place_x[k] : place_x[k] - middle[k] # the clamp is at 0
    from_x[b + 1] = min(from_x[b + 1], held_x - platform_length/2)
    to_x[b + 1] = max(to_x[b + 1], held_x + platform_length/2)
  }
}
_x(side, n, x) = n < 0 ? NaN : place_x[member_of(n)] + (side == 1 ? middle[member_of(n)] - x : x - middle[member_of(n)])
stats 'shapes.dat' using (_x(0, node(0), ribbon_x(1))) name 'near' nooutput
stats 'shapes.dat' using (_x(half, node(0), ribbon_x(ribbons))) name 'far' nooutput
beside = hanging ? 0.5*(box_top - box_bottom) : 0 # of films that are slender
left_most = min(near_min, far_min) - beside
right_most = max(near_max, far_max) + beside
wide = right_most - left_most
high = max(box_top - box_bottom, wide/100)
flat = high < 0.3*wide

delay = min(40, max(2, floor(480.0/shown_frames + 0.5))) # of a frame, hundredths of a second
hold = 12 # how often the last frame is repeated
set encoding utf8
set terminal gif animate delay delay loop 0 size 640,480 noenhanced font ',13' background '#ffffff'
set output out
unset key
set grid lc rgb '#dddddd' lw 1 lt 1
set border lc rgb '#333333' lw 1
set format '% h'
set tics nomirror
length = scale(wide, 'm')
time = scale(end, 's')
voltage = scale(drive_voltage, 'V')
set xlabel 'x / '.unit(wide, 'm')
set ylabel 'y / '.unit(wide, 'm')
set tmargin 5
set bmargin 5
if (!flat) { set size ratio -1 }
if (high > wide) { set xtics step(wide*length, 4) }
set xrange [(left_most - 0.04*wide)*length:(right_most + 0.04*wide)*length]
set yrange [(box_bottom - 0.2*high)*length:(box_top + 0.1*high)*length]
slower = delay/100.0*(shown_frames - 1)/(end - begin)
pace = path ? 'equilibria one after the other, stable or not' \
     : slower >= 1 ? sprintf('slow motion, %.3g times slower than real', slower) \
     : sprintf('fast motion, %.3g times faster than real', 1/slower)
set label 2 subtitle at screen 0.5,0.925 center
set label 3 pace at screen 0.5,0.885 center
set label 4 (path ? '' : foot).(flat ? (path ? '' : '; ').'x and y have different scales' : '') at screen 0.5,0.025 center font ',11' tc rgb '#555555'

thick = 0.012*min(high, wide)*length*(flat ? 1 : 2)
grey = '#555555'
set object 1 rectangle from from_x[1]*length,-thick to to_x[1]*length,2*thick fc rgb grey fs solid noborder
do for [k=1:shown_frames + hold] {
  i = word(snapshots, min(k, shown_frames)) + 0
  volts = path || one_voltage ? sprintf('%.4g kV', frame_voltage[i]/1000.0) : ''
  set label 1 (path ? volts : sprintf(unit(end, 's') eq 's' ? 't = %.2f s    %s' : 't = %.1f '.unit(end, 's').'    %s', frame_time[i]*time, volts)) at screen 0.5,0.965 center
  do for [b=1:bodies] {
    y = height[(b - 1)*frames + i]*length
    set object b + 1 rectangle from from_x[b + 1]*length,y-thick to to_x[b + 1]*length,y+thick fc rgb grey fs solid noborder
    if (bodies <= 12 && holds[b]) { set label b + 10 word(bodies_named, b) at to_x[b + 1]*length,y+thick left offset 0.3,0.6 font ',11' tc rgb '#37434d' front }
    if (bodies <= 12 && !holds[b]) { set label b + 10 word(bodies_named, b) at (from_x[b + 1] + to_x[b + 1])/2*length,y-thick center offset 0,-0.6 font ',11' tc rgb '#37434d' front }
  }
  plot for [side=0:half] 'shapes.dat' index i-1 using (has_platform ? _x(side, node(0), $5)*length : NaN):($6*length):($8*length) with filledcurves fc rgb '#e2f1fa' notitle, \
       for [side=0:half] for [r=1:ribbons] 'shapes.dat' index i-1 using (_x(side, node(0), ribbon_x(r))*length):(ribbon_y(r)*length) \
         with lines lw 2 lc rgb '#37434d' notitle, \
       for [side=0:half] 'shapes.dat' index i-1 using (node(0) % nodes == 0 || (!half && node(0) % nodes == nodes - 1) ? _x(side, node(0), ribbon_x(ribbons))*length : NaN):(ribbon_y(ribbons)*length) \
         with points pt 5 ps 1 lc rgb '#37434d' notitle
}
