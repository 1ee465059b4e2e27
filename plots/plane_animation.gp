#picture animation.gif one motion time_s @output.animation :shapes.dat :planar
#picture animation.gif one branch|held_branch voltage_V @output.animation :shapes.dat +drive.voltage :planar
# Bodies in the plane, with the members, joints and springs between them, as a film.
load 'of_box.gp'
load 'one_voltage.gp'
load 'subtitle.gp'
most = 80
load 'snapshots.gp'
shown = words(snapshots)
path = kind ne 'motion'
if (path) {
  array row_of[frames]
  do for [i=1:frames] { row_of[i] = min(int(frame_time[i]/stride), rows - 1) + 1 }
} else {
  load 'note.gp'
  load 'at_frames.gp'
}
array pose_x[words(bodies_named)*shown]
array pose_y[words(bodies_named)*shown]
array pose_turn[words(bodies_named)*shown]
array of_row[rows]
do for [b=1:words(bodies_named)] {
  do for [what in 'x_m y_m angle_rad'] {
    name = word(bodies_named, b).'.'.what
    set datafile separator ','
    set datafile columnheaders
    _found = has(name)
    _constant = exists('lowest_'.plain(name)) ? of('lowest_', name) : 0
    stats '../table.csv' using (of_row[int(column(0)) + 1] = column(name), 1) nooutput
    set datafile separator whitespace
    unset datafile columnheaders
    do for [i=1:shown] {
      now = of_row[row_of[word(snapshots, i) + 0]]
      if (what eq 'x_m') { pose_x[(b - 1)*shown + i] = now }
      if (what eq 'y_m') { pose_y[(b - 1)*shown + i] = now }
      if (what eq 'angle_rad') { pose_turn[(b - 1)*shown + i] = now }
    }
  }
}
load 'plane.gp'
wide = box_right - box_left
high = box_top - box_bottom
delay = min(40, max(2, floor(480.0/shown + 0.5))) # of a frame, hundredths of a second
hold = 12 # how often the last frame is repeated
set encoding utf8
set terminal gif animate delay delay loop 0 size 640,480 noenhanced font ',13' background '#ffffff'
set output out
unset key
set grid lc rgb '#dddddd' lw 1 lt 1
set border lc rgb '#333333' lw 1
set format '% h'
set tics nomirror
size = max(wide, high)
length = scale(size, 'm')
time = scale(end, 's')
set xlabel 'x / '.unit(size, 'm')
set ylabel 'y / '.unit(size, 'm')
set tmargin 5
set bmargin 5
set size ratio -1
set xrange [(box_left - 0.06*size)*length:(box_right + 0.06*size)*length]
set yrange [(box_bottom - 0.08*size)*length:(box_top + 0.06*size)*length]
joint_size = 0.008*size*length
slower = delay/100.0*(shown - 1)/(end - begin)
pace = path ? 'equilibria one after the other, stable or not' \
     : slower >= 1 ? sprintf('slow motion, %.3g times slower than real', slower) \
     : sprintf('fast motion, %.3g times faster than real', 1/slower)
set label 2 subtitle at screen 0.5,0.925 center
set label 3 pace at screen 0.5,0.885 center
set label 4 (path ? '' : foot) at screen 0.5,0.025 center font ',11' tc rgb '#555555'
do for [k=1:shown + hold] {
  i = min(k, shown)
  frame = word(snapshots, i) + 0
  volts = path || one_voltage ? sprintf('%.4g kV', frame_voltage[frame]/1000.0) : ''
  set label 1 (path ? volts : sprintf(unit(end, 's') eq 's' ? 't = %.2f s    %s' : 't = %.1f '.unit(end, 's').'    %s', frame_time[frame]*time, volts)) at screen 0.5,0.965 center
  load 'plane_bodies.gp'
  plot for [m=1:members] for [r=1:ribbons] 'shapes.dat' index frame-1 using (int($4)/nodes == m - 1 ? column(x_of(r))*length : NaN):(column(x_of(r) + 1)*length) \
       with lines lw 2 lc rgb colour(1) notitle
}
