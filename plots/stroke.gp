#picture stroke.svg one motion stroke_m
# Stroke, opening and contraction of one run over time.
load 'functions.gp'
opens = has('opening_m')
title = opens ? 'Stroke and opening over time' : 'Stroke over time'
load 'note.gp'
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
  list = 'contraction'
  titles = 'contraction'
  quantity = 'contraction'
  si = '%'
  sized = list
  load 'curves.gp'
  unset multiplot
}
