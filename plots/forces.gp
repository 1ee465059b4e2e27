#picture forces.svg many held_branch|field force_N :axis
# Force on what is held, or on a ribbon of a given shape, against the list key that varies fastest.
title = kind ne 'held_branch' ? 'Electric force on a ribbon of one half' \
      : actuator_kind eq 'electro_ribbon' ? 'Force on the held platform' : 'Force on the held end'
numbers = 'force_N'
load 'held_curves.gp'
factor = scale(largest('force_N'), 'N')
set ylabel label('force', unit(largest('force_N'), 'N')) offset 0.5
plot for [k=1:|curve|] '../table.csv' every ::first[k]::last[k] using (x(0)):(column('force_N')*factor) \
     with linespoints lw 2 dt dash(k) pt mark(k) ps 0.7 lc rgb shade_of(k) title curve[k]
