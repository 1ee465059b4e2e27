# Opening at rest, or the stroke of a kind that has none, against voltage, with pull-in, closing and release.
what = travel eq 'opening_m' ? 'opening' : 'stroke'
title = travel eq 'opening_m' ? 'Opening at rest against voltage' : 'Stroke at rest against voltage'
load 'along_voltage.gp'
factor = scale(largest(travel), 'm')
tag = 11; name = 'pull-in'; at = pull_in_at; from = pull_in_from; to = pull_in_to
load 'jump.gp'
tag = 13; name = 'closing'; at = closing_at; from = closing_from; to = closing_to
load 'jump.gp'
tag = 12; name = 'release'; at = release_at; from = release_from; to = release_to
load 'jump.gp'
set ylabel label(what, unit(largest(travel), 'm')) offset 0.5
set autoscale y noextend
set offsets 0, 0, graph 0.05, graph 0.03
shown = travel
load 'states.gp'
