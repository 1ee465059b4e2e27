#picture profiles.svg one motion time_s :shapes.dat
# Shapes of a run, coloured by their time.
load 'of_box.gp'
most = 8
load 'snapshots.gp'
title = (hanging ? 'Shapes of the films' : ribbons > 1 ? 'Shapes of the ribbons' : 'Shapes of the ribbon').(half ? ', left half' : '')
load 'note.gp'
if (!same_scale) remark = 'x and y have different scales'
right = 0.79
if (same_scale) {
  load 'shape_ratio.gp'
}
load 'style.gp'
load 'of_shapes.gp'
time = scale(end, 's')
load 'scale_of_shades.gp'
set cblabel label('time', unit(end, 's')) offset 0.5
set cbrange [begin*time:end*time]
set cbtics step((end - begin)*time, 5)
tics = 12
if (same_scale) {
  load 'fill_shapes.gp'
} else {
  set autoscale noextend
  set offsets graph 0.02, graph 0.02, graph 0.04, graph 0.04
}
plot for [f in snapshots] for [k=1:hanging*ribbons] 'shapes.dat' index int(f)-1 \
       using (ribbon_x(k)*length):(electrode_y(k)*length):(frame_time[f+0]*time) with lines lw 5 lc palette z notitle, \
     for [f in snapshots] for [k=1:ribbons] 'shapes.dat' index int(f)-1 \
       using (ribbon_x(k)*length):(ribbon_y(k)*length):(frame_time[f+0]*time) with lines lw 2 lc palette z notitle
