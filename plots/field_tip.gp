#picture field_tip.svg one field :field.dat +drive.voltage
# Electric field where the ribbons part: from a little left of the clip's edge (x = 0) to where the gap is as wide as both
# insulators, but a fiftieth of the ribbon at least.
title = 'Electric field where the ribbons part'
load 'ends_of_field.gp'
closed = NaN
parted = right_x
stats 'field.dat' every :::surface_at[2]::surface_at[2] using 1 nooutput
array low_y[int(STATS_records)]
_apart(x, gap) = (closed = closed == closed ? closed : gap, parted = gap > 2*closed && x > 0.02*right_x && x < parted ? x : parted, 1)
stats 'field.dat' every :::surface_at[2]::surface_at[2] using (low_y[int(column(0)) + 1] = $2, 1) nooutput
stats 'field.dat' every :::surface_at[5]::surface_at[5] using ($1 >= left_x ? _apart($1, $2 - low_y[int(column(0)) + 1]) : 1) nooutput
stats 'field.dat' using ($7 >= 0 && $1 >= left_x && $1 <= parted ? $1 : NaN):2 name 'tip' nooutput
box_left = max(left_x, -0.15*parted)
box_right = parted
margin = 0.04*(tip_max_y - tip_min_y)
box_bottom = tip_min_y - margin
box_top = tip_max_y + margin
decades = 0
load 'of_field.gp'
