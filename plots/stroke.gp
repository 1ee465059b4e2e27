# Stroke, opening and contraction of one run over time.
load 'functions.gp'
opens = has('opening_m')
title = opens ? 'Stroke and opening over time' : 'Stroke over time'
foot = note
load 'over_time.gp'
contracts = has('contraction')
list = 'stroke_m opening_m'
titles = 'stroke opening'
quantity = opens ? 'length' : 'stroke'
si = 'm'
sized = list
if (contracts) {
  load 'upper_panel.gp'
}
load 'zip_mark.gp'
if (!contracts) {
  load 'zip_name.gp'
}
load 'curves.gp'
if (contracts) {
  load 'lower_panel.gp'
  load 'zip_name.gp'
  set ylabel 'contraction / %' offset 0.5
  plot '../table.csv' using (column('time_s')*time):(column('contraction')*100) with lines lw 2 lc rgb colour(3) \
       title 'contraction'
  unset multiplot
}
