# Axes of shapes: the unit of both, and the same scale and tics on both where shapes are tall enough to be seen so.
box_size = max(max(abs(box_left), abs(box_right)), box_top - box_bottom)
length = scale(box_size, 'm')
length_unit = unit(box_size, 'm')
set xlabel label(lying ? 'y' : 'x', length_unit)
set ylabel label(lying ? '−x' : 'y', length_unit) offset 0.5
