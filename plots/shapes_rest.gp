#picture shapes.svg one branch|held_branch voltage_V +drive.voltage :shapes.dat
# Shapes at rest along the path of states: as many as can be told apart, about equal movements apart, fewer where a jump
# to another branch is longer. State k is frame at[k].
load 'of_box.gp'
most = 9
total = nodes*members
array x_was[2*total]
array y_was[2*total]
array moved[frames]
do for [k=1:frames] { moved[k] = 0 }
_step(f, i, x, y) = (moved[f] = max(moved[f], f > 1 && x == x ? sqrt((x - x_was[i])**2 + (y - y_was[i])**2) : 0), \
                     x_was[i] = x == x ? x : x_was[i], y_was[i] = y == y ? y : y_was[i])
_node(i) = i == i ? int(i) + 1 : 1
do for [r=1:ribbons] {
  stats 'shapes.dat' using (_step(column(1) == column(1) ? int(column(1)) + 1 : 1, _node(column(4)) + (r - 1)*total, column(x_of(r)), column(x_of(r)+1)), 1) nooutput
}
way = 0
do for [k=1:frames] { way = way + moved[k] }
part = (way > 0 ? way : 1)/(most - 1) # a held plate does not move
next = part
way = 0
chosen = '1 '
do for [k=2:frames-1] {
  way = way + moved[k]
  if (way >= next && words(chosen) + 1 < most) {
    chosen = chosen.sprintf('%d ', k)
    next = part*(floor(way/part) + 1)
  }
}
chosen = chosen.sprintf('%d', frames)
array stable_row[rows]
set datafile separator ','
set datafile columnheaders
stats '../table.csv' using (stable_row[int(column(0)) + 1] = column('stable') > 0, 1) nooutput
set datafile separator whitespace
unset datafile columnheaders
array at[words(chosen)]
array stable[|at|]
do for [k=1:|at|] {
  at[k] = word(chosen, k) + 0
  stable[k] = stable_row[min(int(frame_time[at[k]]/stride), rows - 1) + 1]
}
title = 'Shapes at rest'.(half ? ', left half' : '')
letters = 13
remark = (sum [k=1:|stable|] (1 - stable[k])) > 0 ? 'dashed: unstable' : ''
if (!same_scale) remark = remark.(remark eq '' ? '' : '; ').'x and y have different scales'
if (same_scale) {
  load 'shape_ratio.gp'
  shapes = 24*(|stable| + 1)
}
load 'style.gp'
set key title 'along the path' left font ',12'
load 'of_shapes.gp'
tics = 10
if (same_scale) {
  load 'fill_shapes.gp'
} else {
  set autoscale noextend
  set offsets graph 0.02, graph 0.02, graph 0.04, graph 0.04
}
voltage = scale(drive_voltage, 'V')
plot for [c=1:counter] 'shapes.dat' index 0 using (counter_x($4)*length):(counter_face(counter_x($4))*length) with lines lw 5 lc rgb '#aaaaaa' notitle, \
     for [k=1:|at|] for [r=1:hanging*ribbons] 'shapes.dat' index at[k]-1 using (ribbon_x(r)*length):(electrode_y(r)*length) with lines lw 5 \
     lc rgb shade((k - 1.0)/(|stable| - 1)) notitle, \
     for [k=1:|at|] for [r=1:ribbons] 'shapes.dat' index at[k]-1 using (ribbon_x(r)*length):(ribbon_y(r)*length) with lines lw 2 dt 2-stable[k] \
     lc rgb shade((k - 1.0)/(|stable| - 1)) \
     title (r == 1 ? sprintf('%.3g %s', frame_voltage[at[k]]*voltage, unit(drive_voltage, 'V')) : '')
