# Shapes at rest along the path of states: voltage_at[k] and stable[k] of each.
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
plot for [k=1:|stable|] 'shapes.dat' index k-1 using ($1*length):($2*length) with lines lw 2 dt 2-stable[k] \
     lc rgb shade((k - 1.0)/(|stable| - 1)) \
     title sprintf('%.3g %s', voltage_at[k]*voltage, unit(drive_voltage, 'V'))
