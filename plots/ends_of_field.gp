# Where the metals of field.dat end: left_x, right_x; how high they reach: bottom_y, top_y; how large the grid is: grid_*.
load 'functions.gp'
stats 'field.dat' using 1:2 name 'grid' nooutput
metal_was = 0
_metal(s, x, p) = s != 0 ? NaN : (here = p == 0, either = here || metal_was, metal_was = here, either ? x : NaN)
stats 'field.dat' using (_metal($7, $1, $6)) name 'metal' nooutput
left_x = metal_min
right_x = metal_max
stats 'field.dat' using ($7 >= 0 && $1 >= left_x && $1 <= right_x ? $2 : NaN) name 'surfaces' nooutput
bottom_y = surfaces_min
top_y = surfaces_max
# the blocks of the surfaces 0 to 5
array surface_at[6]
stats 'field.dat' using ($7 >= 0 ? (surface_at[int($7) + 1] = column(-1), 1) : 1) nooutput
