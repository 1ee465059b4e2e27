# One of two panels of lengths in `list` against the voltage, stable states only. `titles` and `quantity` are as for curves.gp.
factor = scale(largest(list), 'm')
set ylabel label(quantity, unit(largest(list), 'm')) offset 0.5
load 'y_tics.gp'
members = words(list)
load 'of_members.gp'
if (members > 4) { set key maxcols 1 spacing 0.8 }
plot for [c in list] '../table.csv' using (column('stable') > 0 ? column('voltage_V')*voltage : NaN):(column(c)*factor) \
     with points pt 7 ps 0.35 lc rgb member_colour(place(c, list)) title member_named(place(c, list), word(titles, place(c, list)))
