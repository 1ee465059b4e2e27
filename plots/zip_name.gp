# What the dashed and the thin line are, beside the axes.
if (zipped == zipped) {
  set label 5 sprintf('zip time %.4g %s', zipped*time, time_unit) at screen right + 0.06, screen 0.20 left font ',12' tc rgb '#555555'
  set arrow 2 from screen right + 0.02, screen 0.20 to screen right + 0.052, screen 0.20 nohead dt 2 lw 1.5 lc rgb '#555555'
}
if (stays > zipped) {
  set label 8 sprintf('closed from %.4g %s', stays*time, time_unit) at screen right + 0.06, screen 0.25 left font ',12' tc rgb '#555555'
  set arrow 5 from screen right + 0.02, screen 0.25 to screen right + 0.052, screen 0.25 nohead dt 1 lw 0.7 lc rgb '#555555'
}
