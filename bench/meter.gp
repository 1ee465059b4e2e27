# The error of the stroke by capacitance: meter.svg from meter.csv
set terminal svg size 900,640 font 'sans-serif,14' background 'white'
set output 'meter.svg'
set datafile separator ','
set multiplot
set lmargin at screen 0.09
set rmargin at screen 0.83
set key at screen 0.99, screen 0.93 right top reverse Left samplen 1.5
set grid lc rgb '#dddddd'
set xrange [0:2.4]
width(name) = name eq 'none' ? 6 : name eq 'edges' ? 3.5 : 1.6
colour(name) = name eq 'none' ? '#bbbbbb' : name eq 'edges' ? '#009e73' : name eq 'leak' ? '#0072b2' : '#d55e00'
of(name, column) = stringcolumn(1) eq name ? column : NaN
set label 1 'Stroke by capacitance: what edges, leak and film do to it' at screen 0.09, screen 0.965 font ',17'
set tmargin at screen 0.92
set bmargin at screen 0.55
set ylabel 'true stroke / mm'
set format x ''
plot for [name in 'none edges leak film'] 'meter.csv' using 2:(of(name, $3) * 1e3) every ::1 with lines lw width(name) lc rgb colour(name) title name
unset label 1
unset key
set tmargin at screen 0.50
set bmargin at screen 0.11
set format x
set xlabel 'time / s'
set ylabel 'reading - true stroke / mm'
set yrange [-6:6]
set arrow from 0.35, graph 0 to 0.35, graph 1 nohead dt 2 lc rgb '#555555'
set label 2 'off' at 0.36, graph 0.07 tc rgb '#555555'
plot for [name in 'none edges leak film'] 'meter.csv' using 2:(of(name, $5) * 1e3) every ::1 with lines lw width(name) lc rgb colour(name)
unset multiplot
