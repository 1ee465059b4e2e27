# A jump from one stable part to another at the voltage `at`: a thin arrow with its voltage beside it; a point where it is
# not known where the jump ends, or where it `ends` nowhere. It begins at the limit point nearest to the voltage, where
# stability changes, and, where the voltage is `rising`, from stable to unstable; it ends at the stable state farthest from
# there. `tag` and `name` are its own.
_goes_on(r) = r < rows && kind_of[r]/2 == kind_of[min(r + 1, rows)]/2
_is_limit(r) = _goes_on(r) && kind_of[r] != kind_of[r + 1] && (!rising || kind_of[r] % 2 == 0)
_is_stable(r) = _goes_on(r) && kind_of[r] == kind_of[r + 1] && kind_of[r] % 2 == 0 && voltage_of[r] != voltage_of[r + 1]
_part(r) = (at - voltage_of[r])/(voltage_of[r + 1] - voltage_of[r])
from = NaN
to = NaN
least = 0.02*at # rows are no closer
do for [r=1:rows] {
  if (_is_limit(r)) {
    do for [i=r:r+1] { if (abs(voltage_of[i] - at) < least) { least = abs(voltage_of[i] - at); from = travel_of[i] } }
  }
}
do for [r=1:rows] {
  if (_is_stable(r) && _part(r) >= 0 && _part(r) <= 1) {
    there = travel_of[r] + _part(r)*(travel_of[r + 1] - travel_of[r])
    if (to != to || abs(there - from) > abs(to - from)) { to = there }
  }
}
if (!ends) { to = NaN }
left = at > 0.66*drive_voltage
whole = to == to
if (at == at && from == from) {
  if (whole) { set arrow tag from at*voltage,from*factor to at*voltage,to*factor front head filled size screen 0.012,18 lw 1.2 lc rgb '#333333' }
  set label tag+20 at at*voltage,from*factor point pt 7 ps 0.6 lc rgb '#333333' front
  said = sprintf('%s %.4g %s', name, at*voltage, voltage_unit)
  beside = whole ? (from + to)*factor/2 : from*factor
  if (left) { set label tag+10 said at at*voltage,beside right offset char -1,0 front font ',12' }
  if (!left) { set label tag+10 said at at*voltage,beside left offset char 1,0 front font ',12' }
}
