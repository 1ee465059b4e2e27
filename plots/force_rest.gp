#picture force.svg one held_branch voltage_V force_N +drive.voltage
# Force on the held platform at rest against voltage.
title = (actuator_kind eq 'electro_ribbon' ? 'Force on the held platform' : 'Force on the held end').' against voltage'
load 'along_voltage.gp'
factor = scale(largest('force_N'), 'N')
set ylabel label('force', unit(largest('force_N'), 'N')) offset 0.5
set autoscale y noextend
set offsets 0, 0, graph 0.05, graph 0.03
shown = 'force_N'
load 'states.gp'
