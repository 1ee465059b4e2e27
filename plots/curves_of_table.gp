# Which curves of a sweep are drawn: against the list key that varies fastest, curve k in the rows first[k] to last[k] of
# the table, called curve[k]. At most `most` of those that have a point of the columns `number`, `curves` in all, are drawn:
# of each of the other keys about the same share of its values, evenly chosen with both ends, and each that is drawn of
# one with all that are drawn of the others. Of three keys, `alike` successive curves have the same value of the first.
most = 10
others = words(axes) - 1
row_length = length_of(others + 1)
_product(n) = n < 1 ? 1 : length_of(n)*_product(n - 1)
all_curves = _product(others)
array points[all_curves]
do for [c=1:all_curves] { points[c] = 0 }
_is(x) = x == x
_any(l, n) = n == 0 ? 0 : _any(l, n - 1) + _is(column(word(l, n)))
set datafile separator ','
set datafile columnheaders
stats '../table.csv' using (c = int(column(0))/row_length + 1, points[c] = points[c] + _any(numbers, words(numbers)), 1) nooutput
# rank[o[a] + j]: the how-manieth, from 0, value j of key a is of those with points; used[a]: how many are
array used[others + 1]
array kept[others + 1]
array o[others + 1]
o[1] = 0
do for [a=1:others] { o[a + 1] = o[a] + length_of(a) }
array rank[o[others + 1] + 1]
do for [a=1:others] {
  used[a] = 0
  kept[a] = 1
  do for [j=1:length_of(a)] {
    rank[o[a] + j] = -1
    has_point = 0
    do for [c=1:all_curves] { if (digit((c - 1)*row_length, a) == j - 1 && points[c] > 0) { has_point = 1; break } }
    if (has_point) { rank[o[a] + j] = used[a]; used[a] = used[a] + 1 }
  }
}
_kept(n) = n < 1 ? 1 : kept[n]*_kept(n - 1)
grows = 1
while (grows > 0) {
  grows = 0
  do for [b=1:others] {
    a = others + 1 - b
    if (kept[a] < used[a] && _kept(others)/kept[a]*(kept[a] + 1) <= most) {
      if (grows == 0) { grows = a } else { if (kept[a]*used[grows] < kept[grows]*used[a]) { grows = a } }
    }
  }
  if (grows > 0) { kept[grows] = kept[grows] + 1 }
}
_value_of(a, k) = kept[a] == 1 ? used[a]/2 : (2*k*(used[a] - 1) + kept[a] - 1)/(2*(kept[a] - 1))
_keeps(a, r) = r >= 0 && (sum [k=0:kept[a] - 1] (_value_of(a, k) == r)) > 0
_chosen(c, n) = n < 1 ? 1 : _keeps(n, rank[o[n] + digit((c - 1)*row_length, n) + 1]) && _chosen(c, n - 1)
chosen = ''
curves = 0
do for [c=1:all_curves] {
  if (points[c] > 0) {
    curves = curves + 1
    if (_chosen(c, others)) { chosen = chosen.sprintf('%d ', c) }
  }
}
if (chosen eq '') { chosen = '1' }
array curve[words(chosen)]
array first[words(chosen)]
array last[words(chosen)]
do for [k=1:|curve|] {
  first[k] = (word(chosen, k) - 1)*row_length
  last[k] = first[k] + row_length - 1
  curve[k] = case_name(first[k], others)
}
alike = |curve|
_first(k) = digit(first[k], 1)
if (others >= 2) {
  alike = 1
  while (alike < |curve| && _first(alike + 1 > |curve| ? 1 : alike + 1) == _first(1)) { alike = alike + 1 }
  do for [k=alike:|curve|-1] { if ((_first(k + 1) != _first(k)) != (k % alike == 0)) { alike = |curve|; break } }
}
