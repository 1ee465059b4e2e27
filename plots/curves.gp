# One panel of curves over time. A template sets first
#   list       columns; those that the table lacks are left out. The first has a whole line, the others are drawn over it
#   titles     what the legend calls them
#   quantity   what the y axis shows, in the SI unit `si`
#   sized      columns whose largest value says the prefix
factor = scale(largest(sized), si)
set ylabel label(quantity, unit(largest(sized), si)) offset 0.5
load 'y_tics.gp'
members = words(list)
load 'of_members.gp'
if (members > 4 && exists('middle')) { set key maxcols 1 spacing 0.8 } # in one of two panels
plot for [c in present(list)] '../table.csv' using (column('time_s')*time):(column(c)*factor) \
     with lines lw 2 dt member_dash(place(c, list)) lc rgb member_colour(place(c, list)) \
     title member_named(place(c, list), word(titles, place(c, list)))
