# The box around all shapes of shapes.dat, whether x and y may have the same scale, and how many shapes there are. Column
# x_of(k) and the next one are x and y of ribbon k.
load 'functions.gp'
x_of(k) = 2*k + 1
stats 'shapes.dat' using 3:4 name 'upper' nooutput
stats 'shapes.dat' using (column(x_of(ribbons))):(column(x_of(ribbons) + 1)) name 'lower' nooutput
box_left = min(upper_min_x, lower_min_x)
box_right = max(upper_max_x, lower_max_x)
box_bottom = min(upper_min_y, lower_min_y)
box_top = max(upper_max_y, lower_max_y)
same_scale = box_top - box_bottom > 0.25*(box_right - box_left) && box_right - box_left > 0.15*(box_top - box_bottom)
frames = |frame_time|
begin = frame_time[1]
end = frame_time[frames]
