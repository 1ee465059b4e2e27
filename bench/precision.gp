# Error against CPU time, from swing.csv or zip.csv:  gnuplot -e "motion='swing'" precision.gp
set datafile separator comma
set terminal svg size 640,480 font "sans-serif,13" background rgb "white"
set output motion.".svg"
array N[3] = [21, 61, motion eq "swing" ? 131 : 130]
if (motion eq "swing") {
  set title "A cantilever's swing, 0.1 s, against the converged one"
  set ylabel "rms of the tip's distance / swing, %"
} else {
  set title "Default actuator, 8 g, 10 kV, first 70 ms, against implicit steps at 1e-7, undamped"
  set ylabel "rms of the platform's distance / opening, %"
}
set xlabel "CPU seconds per simulated second, one thread"
set logscale xy
set format "10^{%L}"
set offsets graph 0.03, graph 0.03, graph 0.03, graph 0.03
set grid
set key below maxrows 3 samplen 2
set bmargin 7
pick(steps, nodes) = sprintf("<awk -F, '$1 == \"%s\" && $2 == %d' %s.csv", steps, nodes, motion)
plot for [k = 1:3] pick("implicit", N[k]) using 5:(100 * $6) with linespoints linecolor k pointtype 7 pointsize 0.6 \
       title sprintf("implicit, %d nodes", N[k]), \
     for [k = 1:3] pick("explicit", N[k]) using 5:(100 * $6) with points linecolor k pointtype 4 pointsize 1.3 \
       title sprintf("explicit, %d nodes", N[k])
