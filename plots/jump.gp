# A jump from one stable part to another at a voltage: a thin arrow with its voltage beside it; a point where it is not
# known where the jump ends. `at`, `from`, `to` are the jump; `tag` and `name` are its own.
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
