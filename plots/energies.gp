# Energies of a run over time; a ribbon has no electric ones.
title = 'Energies over time'
load 'over_time.gp'
list = 'kinetic_energy_J axial_energy_J gravity_energy_J field_energy_J electric_work_J drag_loss_J charging_loss_J energy_imbalance_J'
second = '- bending_energy_J - - - contact_loss_J - -'
titles = 'kinetic "axial + bending" gravity field "electric work" losses "charging loss" imbalance'
electric = 'field_energy_J electric_work_J charging_loss_J'
factor = scale(largest(list), 'J')
set ylabel label('energy', unit(largest(list), 'J')) offset 0.5
shown(c) = actuator_kind ne 'ribbon' || place(c, electric) == 0
more(c) = has(word(second, place(c, list))) ? word(second, place(c, list)) : ''
drawn = ''
do for [c in present(list)] { if (shown(c)) { drawn = drawn.c.' ' } }
plot for [c in drawn] '../table.csv' \
     using (column('time_s')*time):((column(c) + (more(c) eq '' ? 0 : column(more(c))))*factor) \
     with lines lw 2 dt dash(place(c, list)) lc rgb colour(place(c, list)) title word(titles, place(c, list))
