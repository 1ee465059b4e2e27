#picture indices.svg many actuate zip_time_s :indices.dat
#picture indices.svg many stationary stroke_m :indices.dat
#picture indices.svg many equilibrium pull_in_voltage_V :indices.dat
#picture indices.svg many modes frequency_1_Hz :indices.dat
#picture indices.svg many isometric force_N :indices.dat
#picture indices.svg many profile scale_factor :indices.dat
#picture indices.svg many limits max_load_kg :indices.dat
#picture indices.svg many cycle opening_max_m :indices.dat
# Which share of the variance of an answer follows from which key: by itself, and with its interactions.
load 'answers.gp'
what = (number_name[1] eq '' ? '' : number_name[1].' ').quantity
title = 'What the scatter of the '.what.' follows from'
keys_of = ''
_note(o, k) = (keys_of = o eq number[1] ? keys_of.k.' ' : keys_of, 1)
stats 'indices.dat' using (_note(strcol(1), strcol(2))) nooutput
array key_name[words(keys_of)]
do for [k=1:|key_name|] { key_name[k] = word(keys_of, k) }
share(v) = strcol(1) eq number[1] ? 100*v : NaN
row(c) = strcol(1) eq number[1] ? |key_name| + 1 - place(strcol(2), keys_of) : NaN
letters = 17
load 'of_keys.gp'
set xlabel 'share of the variance / %'
set xrange [*<0:100<*]
plot 'indices.dat' using (0):(row(0)):(0):(share($3)):(row(0)+0.02):(row(0)+0.38) with boxxyerror fc rgb colour(1) fs solid solid(1) border lc rgb colour(1) title 'by itself', \
     'indices.dat' using (0):(row(0)):(0):(share($6)):(row(0)-0.38):(row(0)-0.02) with boxxyerror fc rgb colour(2) fs solid solid(2) border lc rgb colour(2) title 'with interactions', \
     'indices.dat' using (share($3)):(row(0)+0.2):(share($4)):(share($5)) with xerrorbars pt 0 ps 0 lw 1.5 lc rgb '#333333' notitle, \
     'indices.dat' using (share($6)):(row(0)-0.2):(share($7)):(share($8)) with xerrorbars pt 0 ps 0 lw 1.5 lc rgb '#333333' title '95 % interval'
