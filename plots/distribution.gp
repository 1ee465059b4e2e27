# How large a share of the samples of a campaign lies below a value. Curve k is the column scalar[k] of the table in the
# `rows` rows from start[k] on, of which found[k] have a value and are `independent` in their block.
load 'functions.gp'
title = 'Distribution over the samples'
remark = sprintf('%d samples per curve; those without a value are left out', samples)
letters = 0
do for [k=1:|curve|] { letters = max(letters, strlen(curve[k])) }
if (|curve| == 1) right = 0.96
load 'style.gp'
set datafile missing NaN
set datafile separator ','
set datafile columnheaders
if (!exists('quantity')) { quantity = 'force'; si = 'N' }
size = 0
do for [k=1:|curve|] { size = max(size, largest(scalar[k])) }
factor = scale(size, si)
set xlabel label(quantity, unit(size, si))
set ylabel 'share of the samples below / %' offset 0.5
set yrange [0:100]
alone(i) = int(i) % blocks < independent
plot for [k=1:|curve|] '../table.csv' every ::start[k]::start[k]+rows-1 \
     using (alone(column(0)) ? column(scalar[k])*factor : NaN):(100.0/found[k]) smooth cumulative \
     with lines lw 2 dt dash(k) lc rgb colour(k) title (|curve| == 1 ? '' : curve[k])
