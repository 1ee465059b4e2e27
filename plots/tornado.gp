#picture tornado.svg one motion|branch|held_branch|shape|modes|field|limits :sensitivity.dat
# Derivatives of a run: by how many percent outputs, four at most, change where a key changes by one. The key with the
# largest effect is on top.
title = 'What counts: percent of the outputs per percent of a key'
load 'functions.gp'
outputs = ''
keys_of = ''
_add(l, w) = place(w, l) > 0 ? l : l.w.' '
_note(o, k) = (outputs = words(outputs) < 4 ? _add(outputs, o) : outputs, keys_of = _add(keys_of, k), 1)
stats 'sensitivity.dat' using (_note(strcol(1), strcol(2))) nooutput
array weight[words(keys_of)]
do for [k=1:|weight|] { weight[k] = 0 }
_weigh(k, w) = place(strcol(1), outputs) > 0 ? (weight[k] = max(weight[k], abs(w))) : 0
stats 'sensitivity.dat' using (_weigh(place(strcol(2), keys_of), $3), 1) nooutput
array key_name[|weight|]
sorted = ''
do for [n=1:|weight|] {
  heaviest = 1
  do for [k=1:|weight|] { if (weight[k] > weight[heaviest]) { heaviest = k } }
  weight[heaviest] = -1
  key_name[n] = word(keys_of, heaviest)
  sorted = sorted.key_name[n].' '
}
array output[words(outputs)]
letters = 0
do for [k=1:|output|] {
  output[k] = words_of(word(outputs, k))
  letters = max(letters, strlen(output[k]))
}
row(k) = strcol(1) eq word(outputs, k) ? |key_name| + 1 - place(strcol(2), sorted) : NaN
load 'of_keys.gp'
set xlabel 'change of an output for 1 % of the key / %'
set yzeroaxis lt 1 lw 1 lc rgb '#555555'
set autoscale x
set offsets graph 0.03, graph 0.03, 0, 0
high = 0.8/|output|
top(k) = 0.4 - high*(k - 1)
plot for [k=1:|output|] 'sensitivity.dat' using (0):(row(k)):(0):($3 + 0*row(k)):(row(k)+top(k)-0.9*high):(row(k)+top(k)) \
     with boxxyerror fc rgb colour(k) fs solid solid(k) border lc rgb colour(k) title output[k]
