# The fitted parameters of a further table: its columns `listed` but the first `skipped`. Names and numbers of the summary,
# and what an axis shows.
load 'functions.gp'
parameters = words(listed) - skipped
parameter(k) = word(listed, skipped + k)
_is_key(k) = exists('name_'.plain(parameter(k)))
_called(k) = _is_key(k) ? of('name_', parameter(k)) : parameter(k)[1:_end(parameter(k)) - 1]
_number(k, w) = number(plain(_called(k).w))
best_of(k) = _number(k, '')
error_of(k) = _number(k, '_standard_error')
low_of(k) = _number(k, '_interval_95_low')
high_of(k) = _number(k, '_interval_95_high')
_sized(k) = abs(best_of(k)) + max(2*error_of(k), 0)
factor_of(k) = _is_key(k) ? of('factor_', parameter(k)) : scale(_sized(k), si_of(parameter(k)))
_shown(k) = _is_key(k) ? unit_of(parameter(k)) : unit(_sized(k), si_of(parameter(k)))
_name(k) = _is_key(k) ? name_of(parameter(k)) : words_of(parameter(k))
parameter_label(k) = _shown(k) eq '' ? _name(k) : label(_name(k), _shown(k)) # of a pure number its name: panels are small
remark = ''
do for [k=1:parameters] { if (_shown(k) eq '') { remark = 'names without a unit: pure numbers' } }
