# A dashed line where the actuator has zipped.
zipped = number('zip_time_s')
if (zipped == zipped) \
  set arrow 1 from zipped*time, graph 0 to zipped*time, graph 1 nohead dt 2 lw 1.5 lc rgb '#555555'
