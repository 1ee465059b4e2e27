# Bodies, joints and springs of picture i, as arrows and objects, in units of 1/length. Loaded after plane.gp for each picture.
grey = '#555555'
unset arrow
do for [n=1:limbs] {
  b = limb_body[n]
  is_spring = n > 2*members && n <= 2*members + 2*springs
  if (b > 0 && (_key('body_%d_moves', b, 'vertical') ne 'none')) {
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
  n = 2*members + 2*k - 1
  set arrow from limb_x(n, i)*length,limb_y(n, i)*length to limb_x(n + 1, i)*length,limb_y(n + 1, i)*length nohead lw 1.5 dt 2 lc rgb '#009e73' front
}
do for [k=1:joints] {
  n = 2*members + 2*springs + 2*k - 1
  is_pin = _key('joint_%d_type', k, 'pin') eq 'pin'
  if (is_pin) {
    set object 100 + k circle at limb_x(n, i)*length,limb_y(n, i)*length size joint_size fc rgb '#ffffff' fs solid border lc rgb '#000000' front
  } else {
    set object 100 + k rectangle center limb_x(n, i)*length,limb_y(n, i)*length size 2*joint_size,2*joint_size fc rgb '#ffffff' fs solid border lc rgb '#000000' front
  }
}
do for [b=1:bodies] {
  if (bodies <= 12 && (_key('body_%d_moves', b, 'vertical') ne 'none')) { set label b + 10 word(bodies_named, b) at _x(b, i)*length,_y(b, i)*length right offset -0.8,-0.8 font ',11' tc rgb '#37434d' front }
}
