# The curves of states of rest: column `number` of the file `data`, times `factor`.
plot for [k=1:words(kinds)] data index k-1 using ($1*voltage):(column(number)*factor) with lines \
     lw kind_width(k) dt kind_dash(k) lc rgb kind_colour(k) title kind_title(k)
