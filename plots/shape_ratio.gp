# Before style.gp, where shapes have the same scale on both axes: see there.
shapes = 120
shape_ratio = 1.08*(box_top - box_bottom)/(1.04*(box_right - box_left))
