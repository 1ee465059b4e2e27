# One or two numbers of the summary, number[1] and number[2], against the list key that varies fastest. Of several curves
# colours tell the curve, marks and dashes the number.
load 'functions.gp'
title = answer
remark = answers
numbers = (number[1] ne '') + (number[2] ne '')
right = |list_key| > 1 ? 0.76 : numbers == 2 ? 0.82 : 0.96
if (motion) foot = note
load 'over_key.gp'
size = largest(number[1].' '.number[2])
factor = scale(size, si)
set ylabel label(quantity, unit(size, si)) offset 0.5
set autoscale x noextend
set yrange [0:*]
set offsets graph 0.03, graph 0.03, graph 0.05, 0
drawn = ''
named = ''
do for [j=1:2] {
  if (number[j] ne '' && has(number[j])) { drawn = drawn.sprintf('%d ', j) }
  if (many && number_name[j] ne '' && has(number[j])) { named = named.sprintf('%d ', j) }
}
nth(j) = strlen(j) ? j + 0 : 1 # of an empty list gnuplot looks at the rest of the line, too
mark(i) = i == 2 ? 5 : 7
shade_of(k) = |curve| > 1 ? shade((k - 1.0)/(|curve| - 1)) : shade(0.3)
paint(i, k) = many ? shade_of(k) : colour(i)
plot for [k=1:|curve|] for [j in drawn] '../table.csv' every ::first[k]::last[k] using (x(0)):(column(number[nth(j)])*factor)@word_tics \
       with linespoints lw 2 dt nth(j) pt mark(nth(j)) ps 0.8 lc rgb paint(nth(j), k) \
       title (!many ? number_name[nth(j)] : j eq word(drawn, 1) ? curve[k] : ''), \
     for [j in named] NaN with linespoints lw 2 dt nth(j) pt mark(nth(j)) ps 0.8 lc rgb '#555555' title number_name[nth(j)]
