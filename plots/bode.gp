#picture bode.svg many motion stroke_amplitude_m phase_rad ~drive.frequency_Hz :axis
# Amplitude and phase of the stroke against the frequency of a drive.
title = 'Amplitude and phase of the stroke'
set datafile separator ','
set datafile columnheaders
load 'functions.gp'
stats '../table.csv' using (column('periodic')) nooutput
load 'note.gp'
if (STATS_sum < STATS_records) remark = 'nothing is drawn where the motion is not periodic'
numbers = 'stroke_amplitude_m'
load 'over_key.gp'
set logscale x
set autoscale x noextend
factor = scale(largest('stroke_amplitude_m'), 'm')
load 'upper_panel.gp'
set logscale y
set ylabel label('amplitude', unit(largest('stroke_amplitude_m'), 'm')) offset 0.5
plot for [k=1:|curve|] '../table.csv' every ::first[k]::last[k] using (x(0)):(column('stroke_amplitude_m')*factor) \
     with linespoints lw 2 dt dash(k) pt mark(k) ps 0.8 lc rgb shade_of(k) title curve[k]
xlabel = x_column eq "drive.frequency_Hz" ? "frequency / Hz" : label(x_name, x_unit)
load 'lower_panel.gp'
unset key
unset logscale y
set ytics 45
set ylabel 'phase / degree' offset 0.5
plot for [k=1:|curve|] '../table.csv' every ::first[k]::last[k] using (x(0)):(column('phase_rad')*180/pi) \
     with linespoints lw 2 dt dash(k) pt mark(k) ps 0.8 lc rgb shade_of(k) notitle
unset multiplot
