#picture distribution.svg many actuate zip_time_s :samples
#picture distribution.svg many stationary stroke_m :samples
#picture distribution.svg many equilibrium pull_in_voltage_V|release_voltage_V :samples
#picture distribution.svg many modes frequency_1_Hz :samples
#picture distribution.svg many isometric force_N :samples
#picture distribution.svg many profile scale_factor|paper_factor :samples
#picture distribution.svg many limits max_load_kg :samples
#picture distribution.svg many cycle opening_max_m|opening_min_m|stroke_max_m|stroke_min_m :samples
# How large a share of the samples of a campaign lies below a value: a curve for each combination of the lists' values and
# each answer of the study, eight at most; of an optimisation for its best designs. Curve k is the column scalar[k] of the
# table in the `samples` rows from start[k] on, of which found[k] have a value and are independent.
load 'answers.gp'
title = 'Distribution over the samples'
remark = sprintf('%d samples per curve; those without a value are left out', samples/blocks*independent)
alone(i) = int(i) % blocks < independent
set datafile separator ','
set datafile columnheaders
optimised = exists('objectives')
if (!optimised) { array front[1] = [-1] }
chosen = ''
counts = ''
do for [i=1:optimised ? |front| : cases/samples] {
  c = optimised ? int(front[i])/samples : i - 1
  do for [j=1:2] {
    if (number[j] ne '' && words(chosen) < 16) {
      n = 0
      stats '../table.csv' every ::c*samples::(c+1)*samples-1 using (n = n + (alone(column(0)) && column(number[j]) == column(number[j])), 1) nooutput
      if (n >= 2) { chosen = chosen.sprintf('%d %d ', c, j); counts = counts.sprintf('%d ', n) }
    }
  }
}
array curve[words(counts)]
array scalar[|curve|]
array start[|curve|]
array found[|curve|]
letters = 0
do for [k=1:|curve|] {
  j = word(chosen, 2*k) + 0
  start[k] = word(chosen, 2*k - 1)*samples
  scalar[k] = number[j]
  found[k] = word(counts, k) + 0
  curve[k] = case_name(start[k], words(axes))
  curve[k] = curve[k].(curve[k] ne '' && number_name[j] ne '' ? ', ' : '').number_name[j]
  letters = max(letters, strlen(curve[k]))
}
if (|curve| == 1) right = 0.96
load 'style.gp'
set datafile missing NaN
set datafile separator ','
set datafile columnheaders
size = 0
do for [k=1:|curve|] { size = max(size, largest(scalar[k])) }
factor = scale(size, si)
set xlabel label(quantity, unit(size, si))
set ylabel 'share of the samples below / %' offset 0.5
set yrange [0:100]
plot for [k=1:|curve|] '../table.csv' every ::start[k]::start[k]+samples-1 \
     using (alone(column(0)) ? column(scalar[k])*factor : NaN):(100.0/found[k]) smooth cumulative \
     with lines lw 2 dt dash(k) lc rgb colour(k) title (|curve| == 1 ? '' : curve[k])
