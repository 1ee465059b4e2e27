# Amplitude and phase of the stroke against the frequency of a drive.
title = 'Amplitude and phase of the stroke'
foot = note
right = 0.76
load 'style.gp'
set logscale x
set autoscale x noextend
factor = scale(largest_amplitude_m, 'm')
load 'upper_panel.gp'
set logscale y
set ylabel label('amplitude', unit(largest_amplitude_m, 'm')) offset 0.5
plot for [k=1:|curve|] 'bode.dat' index k-1 using 1:($2*factor) with linespoints lw 2 dt dash(k) pt 7 ps 0.8 lc rgb colour(k) title curve[k]
xlabel = 'frequency / Hz'
load 'lower_panel.gp'
unset logscale y
set ytics 45
set ylabel 'phase / deg' offset 0.5
plot for [k=1:|curve|] 'bode.dat' index k-1 using 1:($3*180/pi) with linespoints lw 2 dt dash(k) pt 7 ps 0.8 lc rgb colour(k) title ''
unset multiplot
