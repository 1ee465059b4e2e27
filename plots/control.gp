#picture control.svg one motion command_V @control.kind
# What a controller holds, and the voltage that holds it.
title = 'What is held, and the voltage that holds it'
load 'note.gp'
load 'over_time.gp'
load 'upper_panel.gp'
# control_signal is what is held; of a noisy signal also what was measured is drawn
suffix = control_signal eq 'contraction' ? '' : control_signal eq 'capacitance' ? '_F' : '_m'
sized = control_signal.suffix
list = sized.' setpoint'.suffix.(control_noise > 0 ? ' measured'.suffix : '')
titles = control_signal.' setpoint measured'
quantity = control_signal
si = control_signal eq 'contraction' ? '%' : substr(suffix, 2, 2)
load 'curves.gp'
load 'lower_panel.gp'
list = source_model eq 'ideal' ? 'command_V' : 'voltage_V command_V'
titles = source_model eq 'ideal' ? 'command' : 'electrodes command'
quantity = 'voltage'
si = 'V'
sized = list
load 'curves.gp'
unset multiplot
