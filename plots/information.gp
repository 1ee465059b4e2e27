#picture information.svg one fit :likelihood :panel|:panels
# What each measurement tells about each fitted parameter: its share of what all tell, the effect of the other parameters
# taken out. A panel for each column of measurements; the legend adds up its rows.
load 'panels.gp'
title = 'What each measurement tells about each fitted value'
prefix = 'information_'
_told(l, n) = n > words(l) ? '' : (word(l, n)[1:strlen(prefix)] eq prefix ? word(l, n).' ' : '')._told(l, n + 1)
told = _told(all_columns, 1)
shares = words(told)
array share_in[shares]
array total[shares]
array share_name[shares]
letters = 0
do for [j=1:shares] {
  share_in[j] = place(word(told, j), all_columns) + 1
  share_name[j] = escaped(word(told, j)[strlen(prefix) + 1:])
  letters = max(letters, strlen(share_name[j]) + 3)
}
lines = max(150, 20*shares)
height = 70 + (lines + 60)*panels
load 'style.gp'
at(y) = 1 - y/(1.0*height) # y in pixels from above
set tics font ',11'
told_of(j) = sprintf('%s: %.0f %%', share_name[j], total[j])
set multiplot
do for [k=1:panels] {
  if (k > 1) { unset label }
  above = 66 + (lines + 60)*(k - 1)
  set tmargin at screen at(above)
  set bmargin at screen at(above + lines - 6)
  load 'of_fit.gp'
  share(j) = column(share_in[j])*100 + 0*residual(0)
  most = 0
  do for [j=1:shares] {
    stats data using (x(0)):(share(j)) name 'of' nooutput
    total[j] = of_sum_y
    most = max(most, of_max_y)
  }
  beside(j) = over_time ? 0 : (j - 0.5*(shares + 1))*0.012*(measured_max_x - measured_min_x)
  set autoscale noextend
  set yrange [0:*]
  set offsets graph 0.05, graph 0.05, graph 0.08, 0
  set ytics step(most*1.08, 5)
  set xlabel label(x_name[k], x_unit[k]) font ',12' offset 0,0.5
  set ylabel quantity[k].': share / %' font ',12' offset 0.5
  set key at screen right + 0.015, at(above - 8) left top Left reverse samplen 2 spacing 1 maxcols 1 font ',11'
  plot for [j=1:shares] for [r=1:records] data using (x(0)):(of_record(r, share(j))) with lines lw 2 dt dash(j) lc rgb colour(j) title (r == 1 ? told_of(j) : ''), \
       for [j=1:!over_time*shares] data using (x(0) + beside(j)):(share(j)) with impulses lw 2 lc rgb colour(j) notitle, \
       for [j=1:!over_time*shares] data using (x(0) + beside(j)):(share(j)) with points pt (4 + j) ps 0.7 lc rgb colour(j) title told_of(j)
}
unset multiplot
