# Shapes of a run, coloured by their time.
title = (ribbons > 1 ? 'Shapes of the ribbons' : 'Shapes of the ribbon').(half ? ', left half' : '')
foot = note
if (!same_scale) remark = 'x and y have different scales'
right = 0.82
load 'style.gp'
load 'of_shapes.gp'
time = scale(end, 's')
set palette defined (0 '#440154', 0.25 '#3b528b', 0.5 '#21918c', 0.75 '#5ec962', 1 '#c8d020')
set cblabel label('time', unit(end, 's')) offset 0.5
set cbrange [begin*time:end*time]
set colorbox user origin screen 0.85, screen 0.17 size screen 0.025, screen 0.69
tics = 12
if (same_scale) {
  load 'same_scale.gp'
}
set offsets graph 0.02, graph 0.02, graph 0.04, graph 0.04
plot 'profiles.dat' using ($1*length):($2*length):($3*time) with lines lw 2 lc palette z notitle
