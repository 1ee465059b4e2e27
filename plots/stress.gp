#picture stress.svg one motion max_stress_Pa*2
# Largest stress of the metal over time, with the yield stress where it is not far above.
title = 'Largest stress of the metal over time'
load 'note.gp'
load 'over_time.gp'
load 'zip_mark.gp'
load 'zip_name.gp'
from_zero = 1
if (number('yield_margin') < 2) {
  yields = ribbon_yield_stress*scale(largest('max_stress_Pa'), 'Pa')
  set arrow 3 from graph 0, first yields to graph 1, first yields nohead dt 4 lw 1.5 lc rgb '#d55e00' front
  set label 6 'yield stress' at graph 1, first yields left offset 0.5,0 font ',12' tc rgb '#d55e00'
  reach = 1.1*yields
}
list = 'max_stress_Pa'
titles = 'stress'
quantity = 'stress'
si = 'Pa'
sized = list
load 'curves.gp'
