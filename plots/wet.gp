# Where there is liquid: all along, or from the clip on as far as a bead reaches, wet_at[k] elements at frame k. wet(i, k,
# x, g), row by row, is x of node i of a left half, at the end of the bead between two nodes, and sets `gap` to g there.
bead = liquid eq 'bead' && members == 1 && has('wet_length_m')
half_nodes = half || actuator_kind ne 'electro_ribbon' ? nodes : nodes/2 # all of a device without a platform
array wet_at[frames]
do for [k=1:frames] { wet_at[k] = 1e9 }
if (bead) {
  load 'at_frames.gp'
  array wet_row[rows]
  stats '../table.csv' using (wet_row[int(column(0)) + 1] = column('wet_length_m'), 1) nooutput
  set datafile separator whitespace
  unset datafile columnheaders
  do for [k=1:frames] { wet_at[k] = wet_row[row_of[k]]/((ribbon_length - platform_length)/2)*(half_nodes - 1) }
}
x_was = 0
gap_was = 0
_part(i, k) = i >= half_nodes ? NaN : i <= wet_at[k] ? 1 : i - 1 < wet_at[k] ? wet_at[k] - (i - 1) : NaN
wet(i, k, x, g) = (p = _part(i, k), gap = gap_was + p*(g - gap_was), x_here = x_was + p*(x - x_was), x_was = x, gap_was = g, p == 1 ? (gap = g, x) : x_here)
