#picture field.svg one field :field.dat +drive.voltage
# Electric field around the ribbons.
title = 'Electric field around the ribbons, left half'
load 'ends_of_field.gp'
margin = 0.12*(top_y - bottom_y)
box_left = left_x - 0.04*(right_x - left_x)
box_right = grid_max_x
box_bottom = bottom_y - margin
box_top = top_y + margin
decades = 2.5
load 'of_field.gp'
