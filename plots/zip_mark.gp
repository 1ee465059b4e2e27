# A dashed line where the actuator has zipped, and a thin one from where on it stays closed, if that is later.
zipped = number('zip_time_s')
if (zipped == zipped) \
  set arrow 1 from zipped*time, graph 0 to zipped*time, graph 1 nohead dt 2 lw 1.5 lc rgb '#555555'
stays = number('closed_from_s')
if (stays > zipped) \
  set arrow 4 from stays*time, graph 0 to stays*time, graph 1 nohead dt 1 lw 0.7 lc rgb '#555555'
