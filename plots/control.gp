# What a controller holds, and the voltage that holds it.
title = 'What is held, and the voltage that holds it'
foot = note
load 'over_time.gp'
load 'upper_panel.gp'
# control_signal is what is held; of a noisy signal also what was measured is drawn
suffix = control_signal eq 'contraction' ? '' : control_signal eq 'capacitance' ? '_F' : '_m'
sized = control_signal.suffix
list = (control_noise > 0 ? 'measured'.suffix.' ' : '').'setpoint'.suffix.' '.sized
titles = (control_noise > 0 ? 'measured ' : '').'setpoint '.control_signal
quantity = control_signal
si = control_signal eq 'contraction' ? '%' : substr(suffix, 2, 2)
load 'curves.gp'
load 'lower_panel.gp'
list = 'command_V'.(source_model eq 'ideal' ? '' : ' voltage_V')
titles = 'command electrodes'
quantity = 'voltage'
si = 'V'
sized = 'command_V'
load 'curves.gp'
unset multiplot
