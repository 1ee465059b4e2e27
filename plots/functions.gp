# What templates compute with. zipact has defined in result.gp
#   study, kind, outcome, liquid        words
#   drive_voltage, said_drive_voltage   each key in SI or as a word, and as people write it
#   zip_time_s                          each number of the summary of one run
#   columns, lists, axes                names between spaces: columns of ../table.csv that have two numbers; list keys; of
#                                       those that vary together only the last
#   lowest_NAME, highest_NAME, count_NAME, si_NAME, help_NAME    of a column: its range, how many numbers it has, its SI
#                                       unit, in a table of one run what it is
#   name_NAME, unit_NAME, factor_NAME   of a column that lists a key: what an axis shows
#   values_NAME                         of axes: what their values are called
# In the names of variables, a point of a column is an underscore: plain('load.mass_kg') = 'load_mass_kg'.
plain(c) = strstrt(c, '.') == 0 ? c : plain(c[1:strstrt(c, '.') - 1].'_'.c[strstrt(c, '.') + 1:])
of(what, c) = value(what.plain(c))


# escaped('ribbon.young_modulus'): a text that is shown as it is. shown_unit('um') = 'µm'; said('0.0500001 um') = '0.05 µm'.
# name_of(c), unit_of(c): of a column that lists a key.
escaped(c) = strstrt(c, '_') == 0 ? c : c[1:strstrt(c, '_') - 1].'\_'.escaped(c[strstrt(c, '_') + 1:])
_raised(u) = u eq '' ? '' : (u[1:1] eq '2' ? '²' : u[1:1] eq '3' ? '³' : u[1:1])._raised(u[2:])
shown_unit(u) = u[1:1] eq 'u' && strlen(u) > 1 ? 'µ'._raised(u[2:]) : _raised(u)
_digits(w) = sprintf(strlen(w) > 6 ? '%.4g' : '%.6g', w + 0)
_is_number(s) = strstrt('0123456789-.', s[1:1]) > 0
said(s) = !_is_number(s) ? escaped(s) : words(s) == 1 ? _digits(s) : _digits(word(s, 1)).' '.shown_unit(s[strlen(word(s, 1)) + 2:])
name_of(c) = escaped(of('name_', c))
unit_of(c) = shown_unit(of('unit_', c))

# number('zip_time_s'): the number of the summary; NaN where it has none of this name.
number(c) = exists(c) ? value(c) : NaN

# has('stroke_m'): is there such a column to draw? present(LIST): those of the list that there are; place(NAME, LIST):
# which of the list it is.
has(c) = strstrt(columns, ' '.c.' ') > 0
_present(l, n) = n > words(l) ? '' : (has(word(l, n)) ? word(l, n).' ' : '')._present(l, n + 1)
present(l) = _present(l, 1)
_place(c, l, n) = n > words(l) ? 0 : word(l, n) eq c ? n : _place(c, l, n + 1)
place(c, l) = _place(c, l, 1)

# largest('stroke_m opening_m'): the largest absolute value of all of them.
max(a, b) = a > b || b != b ? a : b
min(a, b) = a < b || b != b ? a : b
_size(c) = exists('lowest_'.plain(c)) ? max(abs(of('lowest_', c)), abs(of('highest_', c))) : 0
_largest(l, n) = n == 0 ? 0 : max(_largest(l, n - 1), _size(word(l, n)))
largest(l) = _largest(l, words(l))

# unit(0.02, 'm') = 'mm', scale(0.02, 'm') = 1000: the SI prefix with which a number has one to three digits before the
# point. A share in '%' and a pure number, '', have none; a mass is shown in g.
_power(x) = x > 0 && x < 1e300 ? floor((log10(x) + 1e-9) / 3) : 0
power(x) = _power(x) < -5 ? -5 : _power(x) > 4 ? 4 : _power(x)
prefix(x) = power(x) == 0 ? '' : word('f p n µ m - k M G T', power(x) + 6)
unit(x, u) = u eq 'kg' ? prefix(x * 1000).'g' : u eq '%' || u eq '' ? u : prefix(x).u
scale(x, u) = u eq 'kg' ? 1000 * 10.0**(-3 * power(x * 1000)) : u eq '%' ? 100.0 : u eq '' ? 1.0 : 10.0**(-3 * power(x))

# label('stroke', 'mm') = 'stroke / mm', label('field', 'MV/m') = 'field / (MV/m)', of a pure number 'factor
# (dimensionless)'.
label(quantity, u) = quantity.(u eq '' ? ' (dimensionless)' : strstrt(u, '/') ? ' / ('.u.')' : ' / '.u)

# legend(n): the first n list keys of a sweep, each on a line so that they fit over the legend; letters_of(n): those of
# the longest. case_name(i, n): the values of the first n in case i, from 0. length_of(k): how many values key k has.
list_key(k) = name_of(word(axes, k))
legend(n) = n < 1 ? '' : n == 1 ? list_key(1) : legend(n - 1).",\n".list_key(n)
letters_of(n) = n < 1 ? 0 : max(letters_of(n - 1), strlen(list_key(n)) - 4)
length_of(k) = words(of('values_', word(axes, k)))
_inside(k) = k == words(axes) ? (exists('samples') ? samples : 1) : length_of(k + 1)*_inside(k + 1)
digit(i, k) = i/_inside(k) % length_of(k)
value_name(k, j) = said(word(of('values_', word(axes, k)), j + 1))
case_name(i, n) = n < 1 ? '' : case_name(i, n - 1).(n > 1 ? ', ' : '').value_name(n, digit(i, n))

# words_of('pull_in_voltage_V') = 'pull in voltage': an output for people, without its unit; has_unit(c): has it one?
has_unit(c) = of('si_', c) ne '1' && of('si_', c) ne 'count'
_end(c) = strstrt(c, '_') == 0 ? 0 : strstrt(c, '_') + _end(c[strstrt(c, '_') + 1:])
_spaced(c) = strstrt(c, '_') == 0 ? c : _spaced(c[1:strstrt(c, '_') - 1].' '.c[strstrt(c, '_') + 1:])
_named(c) = c[1:7] eq 'pull in' ? 'pull-in'.c[8:] : c
words_of(c) = _named(_spaced(has_unit(c) ? c[1:_end(c) - 1] : c))
si_of(c) = has_unit(c) ? of('si_', c) : ''

# span('stroke_m opening_m'): from the lowest to the highest of all of them.
_edge(s, l, n) = n == 0 ? NaN : exists(s.plain(word(l, n))) ? of(s, word(l, n)) : NaN
_low(l, n) = n == 0 ? NaN : min(_low(l, n - 1), _edge('lowest_', l, n))
_high(l, n) = n == 0 ? NaN : max(_high(l, n - 1), _edge('highest_', l, n))
span(l) = _high(l, words(l)) - _low(l, words(l))

# beside(14): the right edge of axes beside which a legend of texts with at most 14 letters has room.
beside(n) = max(0.5, 0.883 - 0.0118*n)

# step(range, 6): the distance of tics, 1, 2 or 5 times a power of ten, of which at most 6 fit into the range.
_ten(x) = 10.0**floor(log10(x))
_step(x) = _ten(x) * (x / _ten(x) <= 1 ? 1 : x / _ten(x) <= 2 ? 2 : x / _ten(x) <= 5 ? 5 : 10)
step(range, n) = _step(range / n)

# colour(1) ... colour(8): colours that colour-blind people can tell apart (Okabe and Ito); as numbers, too.
colour(k) = word('#0072b2 #d55e00 #009e73 #cc79a7 #56b4e9 #e69f00 #000000 #b8a800', (k - 1) % 8 + 1)
colour_number(k) = word('0x0072b2 0xd55e00 0x009e73 0xcc79a7 0x56b4e9 0xe69f00 0x000000 0xb8a800', (k - 1) % 8 + 1) + 0

# dash(1) ... dash(8): how the line of that colour is broken, for prints without colours; style.gp has the longer ones.
dash(k) = (k - 1) % 8 + 1

# shade(0) ... shade(1): a scale from dark to light.
_from(p) = p < 1 ? int(4 * p) : 3
_mix(l, p, k) = floor(word(l, k + 1) + (4 * p - k) * (word(l, k + 2) - word(l, k + 1)) + 0.5)
shade(p) = 65536 * _mix('68 59 33 94 200', p, _from(p)) + 256 * _mix('1 82 145 201 208', p, _from(p)) \
         + _mix('84 139 140 98 32', p, _from(p))
