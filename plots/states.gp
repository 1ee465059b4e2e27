# The curves of states of rest: column `shown` of the table, times `factor`. Where the kind of the states changes on a
# branch, the curve continues to the first state of the other kind.
list = shown
load 'y_tics.gp'
is(c) = 1 + _kind(c)
after(before, now, k) = now == k || (before == k && (before - 1)/2 == (now - 1)/2)
of_kind(k) = (before = column(0) == 0 ? 0 : now, now = is(0), after(before, now, k) ? column(shown)*factor : NaN)
plot for [k=1:words(kinds)] '../table.csv' using (column('voltage_V')*voltage):(of_kind(place(word(kinds, k), kind_list))) \
     with lines lw kind_width(k) dt kind_dash(k) lc rgb kind_colour(k) title kind_title(k)
