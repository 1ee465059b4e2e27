# A dashed line where the actuator has zipped.
if (zip_time_s == zip_time_s) \
  set arrow 1 from zip_time_s*time, graph 0 to zip_time_s*time, graph 1 nohead dt 2 lw 1.5 lc rgb '#555555'
