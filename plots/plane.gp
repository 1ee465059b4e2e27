# Bodies in the plane: where they are in each of `shown` pictures, pose_x, pose_y and pose_turn[(b - 1)*shown + i], and
# what stands on them. Body 0 is the frame. limb(i, n): from the place of a body to one of its points.
bodies = words(bodies_named)
_key(f, k, otherwise) = exists(sprintf(f, k)) ? value(sprintf(f, k)) : otherwise
_drawn(b, what) = b == 0 ? 0 : _key('body_%d_'.what, b, 0)
_x(b, i) = b == 0 ? 0 : pose_x[(b - 1)*shown + i]
_y(b, i) = b == 0 ? 0 : pose_y[(b - 1)*shown + i]
_turn(b, i) = b == 0 ? 0 : pose_turn[(b - 1)*shown + i]
point_x(b, i, u, v) = _x(b, i) + cos(_turn(b, i))*u - sin(_turn(b, i))*v
point_y(b, i, u, v) = _y(b, i) + sin(_turn(b, i))*u + cos(_turn(b, i))*v
# a point of the drawing, along the own axes of a body
own_u(b, x, y) = cos(_drawn(b, 'angle'))*(x - _drawn(b, 'at_x')) + sin(_drawn(b, 'angle'))*(y - _drawn(b, 'at_y'))
own_v(b, x, y) = -sin(_drawn(b, 'angle'))*(x - _drawn(b, 'at_x')) + cos(_drawn(b, 'angle'))*(y - _drawn(b, 'at_y'))

# limbs: points of bodies; bars: platforms, along their members; then springs and joints
springs = exists('springs_named') ? words(springs_named) : 0
joints = exists('joints_named') ? words(joints_named) : 0
limbs = 2*members + 2*springs + 2*joints
array limb_body[limbs]
array limb_u[limbs]
array limb_v[limbs]
limb = 0
do for [k=1:members] {
  do for [end in 'upper lower'] {
    limb = limb + 1
    limb_body[limb] = int(_key('member_%d_'.end, k, 0))
    limb_u[limb] = _key('member_%d_'.end.'_at_x', k, 0)
    limb_v[limb] = _key('member_%d_'.end.'_at_y', k, 0)
  }
}
do for [k=1:springs] {
  do for [end in 'first second'] {
    limb = limb + 1
    limb_body[limb] = int(_key('spring_%d_'.end, k, 0))
    limb_u[limb] = _key('spring_%d_'.(end eq 'first' ? 'from' : 'to').'_at_x', k, 0)
    limb_v[limb] = _key('spring_%d_'.(end eq 'first' ? 'from' : 'to').'_at_y', k, 0)
  }
}
do for [k=1:joints] {
  do for [end in 'first second'] {
    limb = limb + 1
    limb_body[limb] = int(_key('joint_%d_'.end, k, 0))
    _joint_x = _key('joint_%d_at_x', k, 0)
    _joint_y = _key('joint_%d_at_y', k, 0)
    limb_u[limb] = own_u(limb_body[limb], _joint_x, _joint_y)
    limb_v[limb] = own_v(limb_body[limb], _joint_x, _joint_y)
  }
}
limb_x(n, i) = point_x(limb_body[n], i, limb_u[n], limb_v[n])
limb_y(n, i) = point_y(limb_body[n], i, limb_u[n], limb_v[n])
# half a platform of member k at its upper (1) or lower (2) end, as its body has turned
_bar(k, end, i) = _key('member_%d_angle', k, 0) + _turn(limb_body[2*k - 2 + end], i) - _drawn(limb_body[2*k - 2 + end], 'angle')
bar_x(k, end, i) = 0.5*platform_length*cos(_bar(k, end, i))
bar_y(k, end, i) = 0.5*platform_length*sin(_bar(k, end, i))

# A spring with a direction, _facing, leads to its second end from where that is above its first body's face. Faces are
# drawn of those that rub and of those of the frame that push, as far as second ends go along them.
_directed(k) = exists(sprintf('spring_%d_direction', k))
has_face(k) = _directed(k) && _key('spring_%d_kind', k, 'both') eq 'push' && (_key('spring_%d_friction', k, 0) > 0 || limb_body[2*members + 2*k - 1] == 0)
_facing(k, i) = _key('spring_%d_direction', k, 0) + _turn(limb_body[2*members + 2*k - 1], i) - _drawn(limb_body[2*members + 2*k - 1], 'angle')
_apart_x(k, i) = limb_x(2*members + 2*k, i) - limb_x(2*members + 2*k - 1, i)
_apart_y(k, i) = limb_y(2*members + 2*k, i) - limb_y(2*members + 2*k - 1, i)
_beside(k, i) = cos(_facing(k, i))*_apart_y(k, i) - sin(_facing(k, i))*_apart_x(k, i)
_above(k, i) = cos(_facing(k, i))*_apart_x(k, i) + sin(_facing(k, i))*_apart_y(k, i)
spring_x(k, i) = limb_x(2*members + 2*k, i) - (_directed(k) ? cos(_facing(k, i))*_above(k, i) : _apart_x(k, i))
spring_y(k, i) = limb_y(2*members + 2*k, i) - (_directed(k) ? sin(_facing(k, i))*_above(k, i) : _apart_y(k, i))
# a point of the face of spring k, `s` along it and `depth` below it
face_x(k, i, s, depth) = limb_x(2*members + 2*k - 1, i) + cos(_facing(k, i))*(_key('spring_%d_rest', k, 0) - depth) - sin(_facing(k, i))*s
face_y(k, i, s, depth) = limb_y(2*members + 2*k - 1, i) + sin(_facing(k, i))*(_key('spring_%d_rest', k, 0) - depth) + cos(_facing(k, i))*s
array face_from[springs + 1]
array face_to[springs + 1]
do for [k=1:springs] {
  face_from[k] = _beside(k, 1)
  face_to[k] = _beside(k, 1)
  do for [i=1:shown] {
    face_from[k] = min(face_from[k], _beside(k, i))
    face_to[k] = max(face_to[k], _beside(k, i))
  }
}

# the box around all
do for [i=1:shown] {
  do for [n=1:limbs] {
    box_left = min(box_left, limb_x(n, i))
    box_right = max(box_right, limb_x(n, i))
    box_bottom = min(box_bottom, limb_y(n, i))
    box_top = max(box_top, limb_y(n, i))
  }
  do for [b=1:bodies] {
    box_left = min(box_left, _x(b, i))
    box_right = max(box_right, _x(b, i))
    box_bottom = min(box_bottom, _y(b, i))
    box_top = max(box_top, _y(b, i))
  }
}
