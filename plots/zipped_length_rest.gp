#picture zipped_length.svg one branch|held_branch voltage_V >zipped_length_m +drive.voltage
# Closed length at rest against voltage.
title = actuator_kind eq 'electro_ribbon' ? 'Closed length from the clip, one half, against voltage' \
                                          : 'Closed length at rest against voltage'
load 'along_voltage.gp'
factor = scale(largest('zipped_length_m'), 'm')
from_zero = 1
set ylabel label('zipped length', unit(largest('zipped_length_m'), 'm')) offset 0.5
set offsets 0, 0, graph 0.05, 0
shown = 'zipped_length_m'
load 'states.gp'
