# shapes.dat: how many shapes there are, `frames`, at frame_time[k] and frame_voltage[k], of how many ribbons and, one below
# the other, members of how many nodes; whether they are the left half of a symmetric actuator; the box around all of them
# and a counter electrode, as they are drawn (hanging.gp), and whether x and y may have the same scale. Column x_of(k) and
# the next one are x and y of ribbon k.
load 'functions.gp'
x_of(k) = 2*k + 3
members = 0
nodes = 0
_count(i) = i == i ? (nodes = nodes + 1) : (members = members + 1)
stats 'shapes.dat' index 0 using (_count($4), 1) nooutput
ribbons = (STATS_columns - 4)/2
nodes = nodes/members
half = ribbons > 1 && actuator_kind eq 'electro_ribbon' && actuator_symmetry eq 'half' && !exists('in_plane')
stats 'shapes.dat' using 1:(column(x_of(1))) name 'upper' nooutput
frames = int(upper_max_x) + 1
array frame_time[frames]
array frame_voltage[frames]
_frame(k) = (frame_time[k] = $2, frame_voltage[k] = $3)
stats 'shapes.dat' using ($4 == 0 ? (_frame(int($1) + 1), 1) : 1) nooutput
begin = frame_time[1]
end = frame_time[frames]
load 'hanging.gp'
ribbon_x(k) = drawn_x(column(x_of(k)), column(x_of(k) + 1))
ribbon_y(k) = drawn_y(column(x_of(k)), column(x_of(k) + 1))
stats 'shapes.dat' using (ribbon_x(1)):(ribbon_y(1)) name 'upper' nooutput
stats 'shapes.dat' using (ribbon_x(ribbons)):(ribbon_y(ribbons)) name 'lower' nooutput
box_left = min(upper_min_x, lower_min_x)
box_right = max(upper_max_x, lower_max_x)
box_bottom = min(upper_min_y, lower_min_y)
box_top = max(upper_max_y, lower_max_y)
load 'counter.gp'
if (counter) {
  box_right = max(box_right, ribbon_length)
  box_top = max(box_top, max(counter_face(0), counter_face(ribbon_length)))
  box_bottom = min(box_bottom, min(counter_face(0), counter_face(ribbon_length)))
}
same_scale = hanging || box_top - box_bottom > 0.25*(box_right - box_left) && box_right - box_left > 0.15*(box_top - box_bottom)
