# What a study answers with one or two numbers of the summary, drawn against keys: number[1] and number[2], called
# number_name[1] and number_name[2], of the quantity `quantity` in the SI unit `si`; what `answer` is, and for how many
# runs there is one.
load 'functions.gp'
array number = ['', '']
array number_name = ['', '']
answer = ''
counted = 'are drawn'
if (study eq 'actuate') { answer = 'Time to zip'; quantity = 'zip time'; si = 's'; number[1] = 'zip_time_s'; counted = 'zip' }
if (study eq 'stationary') { answer = 'Stroke at rest'; quantity = 'stroke'; si = 'm'; number[1] = 'stroke_m' }
if (study eq 'equilibrium') {
  answer = 'Pull-in and release'; quantity = 'voltage'; si = 'V'; counted = 'pull in'
  number[1] = 'pull_in_voltage_V'; number_name[1] = 'pull-in'
  number[2] = 'release_voltage_V'; number_name[2] = 'release'
}
if (has('strain') && (study eq 'actuate' || !has(number[1]))) { answer = 'Strain'; quantity = 'strain'; si = '%'; counted = 'are drawn'; number[1] = 'strain'; number[2] = '' }
if (study eq 'modes') { answer = 'Lowest frequency about the loaded equilibrium'; quantity = 'frequency'; si = 'Hz'; number[1] = 'frequency_1_Hz' }
if (study eq 'isometric') {
  answer = actuator_kind eq 'electro_ribbon' ? 'Force on the held platform' : 'Force on the held end'
  quantity = 'force'; si = 'N'; number[1] = 'force_N'
}
if (study eq 'profile') {
  answer = 'Electric force, field over plates law'; quantity = 'factor'; si = ''
  number[1] = 'scale_factor'; number_name[1] = 'law as set'
  number[2] = 'paper_factor'; number_name[2] = "paper's method"
}
if (study eq 'limits') { answer = 'Largest load that is lifted slowly'; quantity = 'load'; si = 'kg'; number[1] = 'max_load_kg'; counted = 'lift a load' }
if (study eq 'cycle') {
  quantity = has('opening_max_m') ? 'opening' : 'stroke'; answer = 'Range of the '.quantity; si = 'm'
  number[1] = quantity.'_max_m'; number_name[1] = 'largest'
  number[2] = quantity.'_min_m'; number_name[2] = 'smallest'
}
found = exists('count_'.number[1]) ? of('count_', number[1]) : 0
answers = sprintf('%d of %d runs %s', found, cases, counted)
if (has('zip_time_s')) {
  set datafile separator ','
  set datafile columnheaders
  reopened = 0
  _is(x) = x == x
  stats '../table.csv' using (reopened = reopened + (_is(column('zip_time_s')) && !_is(column('closed_from_s')) && column('contraction') < 0.99), 1) nooutput
  set datafile separator whitespace
  unset datafile columnheaders
  if (reopened > 0) { answers = answers.sprintf(', %d of them end open', reopened) }
}
