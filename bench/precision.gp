# Error against CPU time, from swing.csv or zip.csv:  gnuplot -e "motion='swing'" precision.gp
set datafile separator comma
set terminal svg size 640,560 font "sans-serif,13" background rgb "white"
set output motion.".svg"
if (motion eq "swing") {
  array N = [9, 11, 13, 15, 18, 21, 61]
  set title "A cantilever's swing, 0.1 s, against the converged one"
  set ylabel "rms of the distance / swing, %"
} else {
  array N = [21, 61, 130]
  set title "Zip of 8 g at 10 kV, first 70 ms, without liquid and damping"
  set ylabel "rms of the distance / opening, %"
}
set xlabel "CPU seconds per simulated second, one thread"
set logscale xy
set format "10^{%L}"
set offsets graph 0.03, graph 0.03, graph 0.03, graph 0.03
set grid
set key below maxrows 5 samplen 2
set bmargin |N| + 6
pick(steps, nodes) = sprintf("<awk -F, '$1 == \"%s\" && $2 == %d' %s.csv", steps, nodes, motion)
plot for [k = 1:|N|] pick("implicit", N[k]) using 5:(100 * $6) with linespoints linecolor k pointtype 7 pointsize 0.6 \
       title sprintf("implicit, %d nodes", N[k]), \
     for [k = |N|:|N|] pick("equal", N[k]) using 5:(100 * $6) with points linecolor k pointtype 6 pointsize 1 \
       title sprintf("equal steps, %d nodes", N[k]), \
     for [k = 1:|N|] pick("explicit", N[k]) using 5:(100 * $6) with points linecolor k pointtype 4 pointsize 1.3 \
       title sprintf("explicit, %d nodes", N[k])
