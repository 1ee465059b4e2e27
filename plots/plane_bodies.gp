# Bodies, joints and springs of picture i, as arrows and objects, in units of 1/length. Loaded after plane.gp for each picture.
grey = '#555555'
hatch = 0.02*max(box_right - box_left, box_top - box_bottom)
unset arrow
do for [n=1:limbs] {
  b = limb_body[n]
  is_spring = n > 2*members && n <= 2*members + 2*springs
  is_face = is_spring && (n - 2*members) % 2 == 1 && _directed((n - 2*members + 1)/2)
  if (b > 0 && !is_face && (_key('body_%d_moves', b, 'vertical') ne 'none')) {
    set arrow from _x(b, i)*length,_y(b, i)*length to limb_x(n, i)*length,limb_y(n, i)*length nohead lw (is_spring ? 2 : 5) lc rgb grey back
  }
}
do for [k=1:members] {
  do for [end=1:2] {
    n = 2*k - 2 + end
    set arrow from (limb_x(n, i) - bar_x(k, end, i))*length,(limb_y(n, i) - bar_y(k, end, i))*length \
              to (limb_x(n, i) + bar_x(k, end, i))*length,(limb_y(n, i) + bar_y(k, end, i))*length nohead lw 6 lc rgb (limb_body[n] == 0 ? '#000000' : grey) front
  }
}
do for [k=1:springs] {
  n = 2*members + 2*k
  set arrow from spring_x(k, i)*length,spring_y(k, i)*length to limb_x(n, i)*length,limb_y(n, i)*length nohead lw 1.5 dt 2 lc rgb '#009e73' front
  if (has_face(k)) {
    first = floor(face_from[k]/hatch) - 2
    last = ceil(face_to[k]/hatch) + 2
    set arrow from face_x(k, i, first*hatch, 0)*length,face_y(k, i, first*hatch, 0)*length to face_x(k, i, last*hatch, 0)*length,face_y(k, i, last*hatch, 0)*length nohead lw 2 lc rgb '#000000' front
    do for [s=first:last-1] {
      set arrow from face_x(k, i, (s + 0.5)*hatch, 0)*length,face_y(k, i, (s + 0.5)*hatch, 0)*length to face_x(k, i, s*hatch, 0.6*hatch)*length,face_y(k, i, s*hatch, 0.6*hatch)*length nohead lw 1 lc rgb '#000000' front
    }
  }
}
do for [k=1:joints] {
  n = 2*members + 2*springs + 2*k - 1
  is_pin = _key('joint_%d_type', k, 'pin') eq 'pin'
  if (is_pin) {
    set object 100 + k circle at limb_x(n, i)*length,limb_y(n, i)*length size joint_size fc rgb '#ffffff' fs solid border lc rgb '#000000' front
  } else {
    set object 100 + k rectangle center limb_x(n + 1, i)*length,limb_y(n + 1, i)*length size 2*joint_size,2*joint_size fc rgb '#ffffff' fs solid border lc rgb '#000000' front
  }
}
do for [b=1:bodies] {
  if (bodies <= 12 && (_key('body_%d_moves', b, 'vertical') ne 'none')) { set label b + 10 word(bodies_named, b) at _x(b, i)*length,_y(b, i)*length right offset -0.8,-0.8 font ',11' tc rgb '#37434d' front }
}
