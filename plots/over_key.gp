# Curves of a sweep from its table: the columns `numbers` against the list key that varies fastest, a curve for each value
# of the others. Shades tell the curves in their order; dashes and marks tell neighbours, in grey, too. Of three keys the
# first has a style of line, the second a shade.
load 'functions.gp'
load 'curves_of_table.gp'
x_column = word(axes, words(axes))
x_name = name_of(x_column)
x_unit = unit_of(x_column)
x_factor = of('factor_', x_column)
many = words(axes) > 1
if (!exists('letters')) letters = 0
do for [k=1:|curve|] { letters = max(letters, strlen(curve[k])) }
letters = max(letters, letters_of(words(axes) - 1))
if (!many && letters == 0) right = 0.96
if (curves > |curve|) {
  if (!exists('remark')) { remark = '' }
  remark = (remark eq '' || strstrt(remark, 'are drawn') ? '' : remark.'; ').sprintf('%d of %d curves are drawn', |curve|, curves)
}
load 'style.gp'
set datafile separator ','
set datafile columnheaders
if (many) set key spacing 1 title legend(words(axes) - 1) left font ',12'
set xlabel label(x_name, x_unit)
x(first) = column(x_column)*x_factor
shade_of(k) = shade(alike > 1 ? (alike > 2 ? 0.9 : 0.6)*((k - 1) % alike)/(alike - 1.0) : 0.3)
style_of(k) = alike < |curve| ? (k - 1)/alike + 1 : k
dash(k) = (style_of(k) - 1) % 8 + 1
mark(k) = word('7 6 5 4 9 8 11 10', dash(k)) + 0
