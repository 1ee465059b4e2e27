# Axes of the animation. Its lens changes them in each frame, and they are set again.
set size ratio -1
set size 1,1
set origin 0,0
set lmargin -1
set rmargin -1
set tmargin 5
if (lensed) { set bmargin at screen 0.4 } else { set bmargin 5 }
set border lc rgb '#333333' lw 1
set format '% h'
set tics nomirror
set xlabel (hanging ? 'y / ' : 'x / ').length_unit
set ylabel (hanging ? '−x / ' : 'y / ').length_unit
set xrange [-reach*length - 1.8*u:reach*length + 1.8*u]
set yrange [box_bottom*length - 3*u:box_top*length + 1.2*u]
if (box_top - box_bottom > 2*reach) { set xtics step(2*reach*length, 4) }
