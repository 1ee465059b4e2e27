#picture film.svg one motion >film_thickness_m !member_1_opening_m time_s :shapes.dat
# Liquid between the faces, of the left half where there are two, from the clip to where it ends, at some times.
load 'of_box.gp'
most = 8
load 'snapshots.gp'
load 'wet.gp'
title = 'Liquid between the '.(hanging ? 'films' : 'faces').(actuator_kind eq 'electro_ribbon' ? ', left half' : '')
thickness(r) = ribbons > 1 ? column(6) - column(8) : counter ? counter_face(counter_x(column(4))) - column(6) : NaN
load 'note.gp'
if (bead) remark = 'a curve ends where the bead does'
letters = 8
load 'style.gp'
load 'of_shapes.gp'
least = film_roughness # between closed faces
set logscale y
set format y '10^{%L}'
set xlabel label('x', length_unit)
set ylabel 'distance of the '.(hanging ? 'films' : 'faces').' / µm' offset 0.5
plot for [f in snapshots] 'shapes.dat' index int(f)-1 using (wet($4, f+0, $5, thickness(0))*length):(gap > least ? gap*1e6 : least*1e6) with lines lw 2 \
     lc rgb shade((frame_time[f+0] - begin)/(end - begin)) title sprintf('%.4g %s', frame_time[f+0]*scale(end, 's'), unit(end, 's'))
