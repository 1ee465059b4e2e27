#picture energies.svg one motion kinetic_energy_J
# Where the work on the actuator goes, stacked: rises of stored energies, then all losses. What is negative hangs below 0,
# so that both parts together are the work. A group too small to be seen has no name in the legend.
title = 'Where the work goes'
load 'over_time.gp'
stored = 'gravity_energy_J bending_energy_J axial_energy_J relaxing_energy_J spring_energy_J'
work = 'electric_work_J load_work_J'
array group = [stored, 'kinetic_energy_J liquid_energy_J', 'field_energy_J', 'charging_loss_J', 'viscous_loss_J', 'meniscus_loss_J', \
               'jet_loss_J outer_drag_loss_J', 'contact_loss_J catch_loss_J', 'internal_loss_J drag_loss_J plastic_loss_J relaxation_loss_J leak_loss_J']
array group_name = ['weight, bending', 'motion', 'field', 'charging loss', 'viscous loss', 'menisci', 'jets, outer drag', 'contact', 'damping, leakage']
_sum(l, n) = n == 0 ? 0 : _sum(l, n - 1) + column(word(l, n))
sum_of(l) = _sum(l, words(l))
array before[|group|] # energies at the start
do for [k=1:|group|] {
  group[k] = present(group[k])
  before[k] = 0
}
work = present(work)
stats '../table.csv' every ::1::1 using (sum_of(group[1])) name 'hanging' nooutput
stats '../table.csv' every ::1::1 using (sum_of(group[3]) + sum_of(group[4]) - sum_of(work)) name 'charged' nooutput
before[1] = hanging_min
before[3] = charged_min
part(k) = sum_of(group[k]) - before[k]
above(k) = k == 0 ? 0 : above(k - 1) + max(part(k), 0)
below(k) = k == 0 ? 0 : below(k - 1) + min(part(k), 0)
stats '../table.csv' every ::1 using (above(|group|)) name 'above' nooutput
stats '../table.csv' every ::1 using (below(|group|)) name 'below' nooutput
size = above_max - below_min
factor = scale(size, 'J')
set ylabel label('energy', unit(size, 'J')) offset 0.5
set ytics step(size*factor, 8)
seen = ''
do for [k=1:|group|] { if (group[k] ne '' && largest(group[k]) > 0.003*size) { seen = seen.k.' ' } }
tint(k) = place(''.k, seen) > 0 ? place(''.k, seen) : |group|
paint(k) = tint(k) == 7 ? '#999999' : colour(tint(k))
if (below_min > -0.01*size) { set yrange [0:*] }
set style fill solid 0.55 noborder
plot for [k=1:|group|] '../table.csv' using (column('time_s')*time):(above(k - 1)*factor):(above(k)*factor) with filledcurves lc rgb paint(k) notitle, \
     for [k=1:|group|] '../table.csv' using (column('time_s')*time):(below(k - 1)*factor):(below(k)*factor) with filledcurves lc rgb paint(k) notitle, \
     for [k=1:|group|] '../table.csv' using (column('time_s')*time):(above(k)*factor) with lines lw 0.7 lc rgb '#555555' notitle, \
     for [k in seen] NaN with boxes lc rgb paint(k + 0) title group_name[k + 0], \
     '../table.csv' using (column('time_s')*time):(sum_of(work)*factor) with lines lw 2.5 lc rgb '#000000' title 'work'
