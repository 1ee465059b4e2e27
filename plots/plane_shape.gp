#picture shape.svg one shape :shapes.dat :planar
# Bodies in the plane, at rest, with the members, joints and springs between them.
load 'of_box.gp'
title = 'Bodies and members at rest'
shown = 1
array pose_x[words(bodies_named)]
array pose_y[words(bodies_named)]
array pose_turn[words(bodies_named)]
do for [b=1:words(bodies_named)] {
  pose_x[b] = number('bodies_'.word(bodies_named, b).'_x_m')
  pose_y[b] = number('bodies_'.word(bodies_named, b).'_y_m')
  pose_turn[b] = number('bodies_'.word(bodies_named, b).'_angle_rad')
}
load 'plane.gp'
right = 0.96
load 'shape_ratio.gp'
load 'style.gp'
load 'of_shapes.gp'
tics = 10
load 'fill_shapes.gp'
unset key
joint_size = 0.008*(box_right - box_left)*length
i = 1
load 'plane_bodies.gp'
plot for [k=1:members] for [r=1:ribbons] 'shapes.dat' index 0 using (int($4)/nodes == k - 1 ? column(x_of(r))*length : NaN):(column(x_of(r) + 1)*length) \
     with lines lw 2 lc rgb colour(1) notitle
