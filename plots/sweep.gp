#picture zip_time.svg many actuate zip_time_s !strain :axis
#picture strokes.svg many stationary stroke_m :axis
#picture voltages.svg many equilibrium pull_in_voltage_V|release_voltage_V :axis
#picture strains.svg many actuate|equilibrium strain !pull_in_voltage_V :axis
#picture frequencies.svg many modes frequency_1_Hz :axis
#picture factors.svg many profile scale_factor|paper_factor :axis
#picture loads.svg many limits max_load_kg :axis
#picture openings.svg many cycle opening_max_m|opening_min_m|stroke_max_m|stroke_min_m :axis
# One or two numbers of the summary, number[1] and number[2], against the list key that varies fastest. Of several curves
# shades and dashes tell the curve, full and open marks the number.
load 'answers.gp'
title = answer
remark = answers
if (kind eq 'motion') {
  load 'note.gp'
}
drawn = ''
letters = 0
do for [j=1:2] {
  if (number[j] ne '' && has(number[j])) {
    drawn = drawn.sprintf('%d ', j)
    letters = max(letters, strlen(number_name[j]))
  }
}
numbers = number[1].' '.number[2]
load 'over_key.gp'
size = largest(number[1].' '.number[2])
factor = scale(size, si)
set ylabel label(quantity, unit(size, si)) offset 0.5
set autoscale x noextend
set yrange [0:*]
set offsets graph 0.03, graph 0.03, graph 0.05, 0
nth(j) = strlen(j) ? j + 0 : 1 # of an empty list gnuplot looks at the rest of the line, too
mark(j) = nth(j) == 2 ? 4 : 7
paint(j, k) = many ? shade_of(k) : colour(nth(j))
line(j, k) = many ? dash(k) : nth(j)
named(j) = many && number_name[nth(j)] ne ''
plot for [k=1:|curve|] for [j in drawn] '../table.csv' every ::first[k]::last[k] using (x(0)):(column(number[nth(j)])*factor) \
       with linespoints lw 2 dt line(j, k) pt mark(j) ps 0.8 lc rgb paint(j, k) \
       title (!many ? number_name[nth(j)] : j eq word(drawn, 1) ? curve[k] : ''), \
     for [j in drawn] NaN with points pt mark(j) ps 0.8 lc rgb '#555555' title named(j) ? number_name[nth(j)] : ''
