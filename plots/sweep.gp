# One or two numbers of the summary (`drawn`: 1, 2 or both) against the list key that varies fastest; a curve for each
# value of the other keys. Of several curves colours tell the curve, marks and dashes the number.
right = many ? 0.76 : numbers == 2 ? 0.82 : 0.96
if (motion) foot = note
load 'style.gp'
if (many) set key title legend left font ',12'
factor = scale(largest_value, si)
set xlabel x_label
set ylabel label(quantity, unit(largest_value, si)) offset 0.5
set autoscale x noextend
set yrange [0:*]
set offsets graph 0.03, graph 0.03, graph 0.05, 0
number(j, l) = j > words(l) ? 1 : word(l, j) + 0 # which of both numbers the j-th of a list is
mark(i) = i == 2 ? 5 : 7
shade_of(k) = |curve| > 1 ? shade((k - 1.0)/(|curve| - 1)) : shade(0.3)
if (many) {
  named = ''
  do for [i=1:2] { if (number_name[i] ne '' && strstrt(drawn, sprintf('%d', i))) { named = named.sprintf('%d ', i) } }
  plot for [k=1:|curve|] for [j=1:words(drawn)] data.'.dat' index k-1 using ($1*x_factor):(column(number(j, drawn) + 1)*factor) \
         with linespoints lw 2 dt number(j, drawn) pt mark(number(j, drawn)) ps 0.8 lc rgb shade_of(k) \
         title (j == 1 ? curve[k] : ''), \
       for [j=1:words(named)] NaN with linespoints lw 2 dt number(j, named) pt mark(number(j, named)) ps 0.8 lc rgb '#555555' \
         title number_name[number(j, named)]
} else {
  plot for [j=1:words(drawn)] data.'.dat' index 0 using ($1*x_factor):(column(number(j, drawn) + 1)*factor) \
       with linespoints lw 2 dt number(j, drawn) pt mark(number(j, drawn)) ps 0.8 lc rgb colour(number(j, drawn)) \
       title number_name[number(j, drawn)]
}
