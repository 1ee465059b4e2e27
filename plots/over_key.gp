# Curves of a sweep from its table: against the list key that varies fastest, a curve for each value of the others, curve k
# in the rows first[k] to last[k]. Words of a key stand side by side.
many = |list_key| > 1
load 'style.gp'
set datafile separator ','
set datafile columnheaders
if (many) set key title legend(|list_key| - 1) left font ',12'
set xlabel label(x_name, x_unit)
x(first) = x_words ? column(0) : column(x_column)*x_factor
word_tics = x_words ? ':xticlabels(x_column)' : ''
