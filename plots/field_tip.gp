#picture field_tip.svg one field :field.dat :powered
# Electric field where the ribbons part: from a little left of the clip's edge (x = 0) to where the gap is as wide as both
# insulators, but a fiftieth of the ribbon at least.
title = 'Electric field where the ribbons part'
load 'ends_of_field.gp'
closed = NaN
parted = right_x
_apart(x, gap) = (closed = closed == closed ? closed : gap, parted = gap > 2*closed && x > 0.02*right_x && x < parted ? x : parted, 1)
_column(s) = s == 1 ? (low_y = $2, low_x = $1, 1) : s == 4 && low_x >= left_x ? _apart(low_x, $2 - low_y) : 1
low_x = -1e300
low_y = 0
stats 'field.dat' using (_column($7)) nooutput
stats 'field.dat' using ($7 >= 0 && $1 >= left_x && $1 <= parted ? $1 : NaN):2 name 'tip' nooutput
box_left = max(left_x, -0.15*parted)
box_right = parted
margin = 0.04*(tip_max_y - tip_min_y)
box_bottom = tip_min_y - margin
box_top = tip_max_y + margin
decades = 0
load 'of_field.gp'
