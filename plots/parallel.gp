#picture parallel.svg many motion|branch|held_branch|shape|modes|field|limits :lines
# All cases of a sweep: an axis for each list key, ten at most, and each answer, or objective, that varies, twelve in all,
# and a line for each case, or of very many for some evenly chosen ones, coloured by the first answer. Names are above,
# aslant so that they do not meet, the ends of the ranges at both ends.
load 'answers.gp'
optimised = exists('objectives')
if (!optimised) { array front[1] = [-1] }
_varies(c) = exists('lowest_'.plain(c)) && of('highest_', c) > of('lowest_', c)
_those(l, n) = n == 0 ? '' : _those(l, n - 1).(_varies(word(l, n)) ? word(l, n).' ' : '')
_first(l) = _those(l, words(l))
_cut(l, n) = n == 0 ? '' : _cut(l, n - 1).word(l, n).' '
shown = _first(lists)
shown = _cut(shown, min(10, words(shown)))
colour_axis = words(shown) + 1
shown = shown._first(optimised ? objectives : number[1].' '.number[2])
colour_axis = min(colour_axis, words(shown))
axis_count = min(12, words(shown))
array axis_name[axis_count]
array axis_unit[axis_count]
array axis_si[axis_count]
array axis_factor[axis_count]
array axis_low[axis_count]
array axis_high[axis_count]
do for [k=1:axis_count] {
  c = word(shown, k)
  is_key = exists('name_'.plain(c))
  axis_name[k] = is_key ? name_of(c) : words_of(c)
  axis_unit[k] = is_key ? unit_of(c) : ''
  axis_factor[k] = is_key ? of('factor_', c) : 1.0
  axis_si[k] = is_key ? '' : si_of(c)
  axis_low[k] = of('lowest_', c)
  axis_high[k] = of('highest_', c)
}
title = 'All cases: a line for each'
remark = sprintf('%d cases; those without a value on an axis are left out', cases)
left = 0.03
right = 0.80
height = 480
load 'style.gp'
unset grid
unset xtics
unset ytics
set border 0
set yrange [0:1]
set xrange [-0.2:|axis_name| - 0.8]
size(k) = max(abs(axis_low[k]), abs(axis_high[k]))
factor(k) = axis_factor[k]*scale(size(k), axis_si[k])
name(k) = label(axis_name[k], axis_unit[k].unit(size(k), axis_si[k]))
do for [k=1:|axis_name|] {
  i = k - 1
  set arrow i+10 from i,0 to i,1 nohead lw 1.2 lc rgb '#333333' front
  set label 3*i+10 sprintf('%.4g', axis_high[k] * factor(k)) at i,1 center offset 0,0.7 font ',11'
  set label 3*i+11 sprintf('%.4g', axis_low[k] * factor(k)) at i,0 center offset 0,-0.7 font ',11'
  set label 3*i+12 name(k) at i,1 left rotate by 30 offset -0.5,1.8 font ',11'
}
load 'scale_of_shades.gp'
set bmargin at screen bottom - 0.05
set tmargin at screen 0.65
set colorbox user origin 0.845, bottom - 0.05 size 0.025, 0.65 - bottom
set cblabel name(colour_axis) offset 0.5
set key at screen 0.97, 0.03 right bottom noreverse Right
set datafile separator ','
set datafile columnheaders
at_axis(k) = (column(word(shown, k)) - axis_low[k])/(axis_high[k] - axis_low[k])
_whole(n) = n == 0 ? 0 : _whole(n - 1) + 0*column(word(shown, n)) # NaN where a value is missing
_design(i) = exists('samples') ? i/samples*samples : i
_best(i) = optimised ? (sum [k=1:|front|] (front[k] == _design(i))) > 0 : 0
shade_at(c) = column(word(shown, colour_axis))*factor(colour_axis)
step = (cases + 399)/400
several = optimised ? words(objectives) > 1 : 0
plot for [k=1:axis_count - 1] '../table.csv' every step using (k - 1 + _whole(axis_count)):(at_axis(k)):(1):(at_axis(k + 1) - at_axis(k)):(shade_at(0)) \
       with vectors nohead lw 0.8 lc palette notitle, \
     for [k=1:(optimised ? axis_count - 1 : 0)] '../table.csv' using (_best(int(column(0))) ? k - 1 + _whole(axis_count) : NaN):(at_axis(k)):(1):(at_axis(k + 1) - at_axis(k)) \
       with vectors nohead lw (exists('samples') ? 0.8 : several ? 1.5 : 3) lc rgb '#000000' title (k == 1 ? (several ? 'front' : 'best') : '')
