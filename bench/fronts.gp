# Speed of a zipping front against the curvature ahead, one curve for each width: fronts.csv => fronts.svg
set datafile separator ","
set terminal svg size 640,420 font "sans,12" background "white"
set output "fronts.svg"
set logscale y
set xlabel "K, curvature far ahead over that of static balance"
set ylabel "speed / (F d / 12 mu w l)"
set key top right title "w / l"
at(width) = sprintf("<grep ',%s,' fronts.csv", width)
plot for [width in "2 3 5 10 20 50 inf"] at(width) using 1:3 with linespoints title width
