# Error against cost of rest, swing, limits and zip, from cost.csv, swing.csv and others.csv:  gnuplot cost.gp
set datafile separator comma
set terminal svg size 980,900 font "sans-serif,13" background rgb "white"
set output "cost.svg"
set multiplot layout 2,2
set bmargin 4
set logscale xy
set format "10^{%L}"
set grid
set offsets graph 0.05, graph 0.05, graph 0.05, graph 0.05
set key bottom left samplen 1.5 spacing 0.9
set ylabel "relative error"
of(problem, kind) = sprintf("<awk -F, '$1 == \"%s\" && $2 == \"%s\"' cost.csv", problem, kind)
other(problem, code) = sprintf("<awk -F, '$1 == \"%s\" && $2 == \"%s\"' others.csv", problem, code)
colour(c) = c eq "cubic elements" ? "#c00000" : c eq "discrete elastic rod (C++)" ? "#806000" : "#404040"
array M = ["rod", "mass-spring", "rod explicit", "mass-spring explicit"]
set xlabel "CPU time of a study, ms"
set title "A guided strip hangs under 61 g: stroke"
plot for [m = 1:2] of("rest", M[m]) using 4:5 with linespoints linecolor m pointtype 7 pointsize 0.5 title M[m], \
     for [c in '"cubic elements" "discrete elastic rod (C++)" "MuJoCo hinge chain"'] \
       other("rest", c) using 4:5 with points pointtype 4 pointsize 1.2 linecolor rgb colour(c) title c
set xlabel "CPU time of a simulated second, s"
set yrange [1e-7:1]
set title "A cantilever swings: height of its tip"
swing(steps, nodes) = sprintf("<awk -F, '$1 == \"%s\" && $2 == %d' swing.csv", steps, nodes)
plot for [n in "9 15 21"] swing("implicit", n + 0) using 5:6 with linespoints linecolor (n + 0) / 6 pointtype 7 pointsize 0.5 title "rod, ".n." nodes", \
     for [c in '"cubic elements" "discrete elastic rod (C++)" "MuJoCo 3.14"'] \
       other("swing", c) using 4:5 with points pointtype 4 pointsize 1.2 linecolor rgb colour(c) title c
set autoscale y
set xlabel "CPU time of a study, ms"
set title "Limits of the default actuator, dry: pull-in, by number of nodes"
plot for [m = 1:2] of("limits", M[m]) using 4:5 with points linecolor m pointtype 7 pointsize 0.5 title M[m], \
     for [m = 1:2] of("limits", M[m]) using 4:5:3 with labels textcolor linetype m offset 0.6,0.6 font ",10" notitle
set title "Zip of the default actuator, dry, undamped: zip time"
plot for [m = 1:4] of("zip", M[m]) using 4:5 with linespoints linecolor m pointtype 7 pointsize 0.5 title M[m]
unset multiplot
