# The row of the table that is nearest in time to each frame: row_of[k], from 1. Loaded before style.gp.
array row_of[frames]
array row_time[rows]
set datafile separator ','
set datafile columnheaders
stats '../table.csv' using (row_time[int(column(0)) + 1] = column('time_s'), 1) nooutput
row = 1
_distance(r, t) = r > rows ? 1e300 : abs(row_time[r] - t)
do for [k=1:frames] {
  while (_distance(row + 1, frame_time[k]) <= _distance(row, frame_time[k]) && row < rows) { row = row + 1 }
  row_of[k] = row
}
