# How large a share of the samples of a campaign lies below a value; curve[k] names the curves.
title = 'Distribution over the samples'
remark = sprintf('%d samples per curve; those without a value are left out', samples)
right = 0.76
load 'style.gp'
factor = scale(largest_value, si)
set xlabel label(quantity, unit(largest_value, si))
set ylabel 'share of the samples below / %' offset 0.5
set yrange [0:100]
plot for [k=1:|curve|] 'distribution.dat' index k-1 using ($1*factor):2 with lines lw 2 dt dash(k) lc rgb colour(k) title curve[k]
