#picture stroke.svg one branch voltage_V !:bodies +drive.voltage
# Opening at rest, or the strain or stroke of a kind that has none, against voltage, with pull-in, closing and release.
load 'functions.gp'
opens = has('opening_m')
strains = has('strain')
title = (strains ? 'Strain' : opens ? 'Opening' : 'Stroke').' at rest against voltage'
load 'along_voltage.gp'
si = strains ? '%' : 'm'
factor = scale(largest(travel), si)
tag = 11; name = 'pull-in'; at = number('pull_in_voltage_V'); rising = 1
ends = !(number('closing_voltage_V') > (1 + 1e-6)*at)
load 'jump.gp'
if (!whole) {
  tag = 13; name = 'closing'; at = number('closing_voltage_V'); ends = 1
  load 'jump.gp'
}
tag = 12; name = 'release'; at = number('release_voltage_V'); rising = 0; ends = 1
load 'jump.gp'
set ylabel label(strains ? 'strain' : opens ? 'opening' : 'stroke', unit(largest(travel), si)) offset 0.5
set autoscale y noextend
set offsets 0, 0, graph 0.05, graph 0.03
shown = travel
load 'states.gp'
