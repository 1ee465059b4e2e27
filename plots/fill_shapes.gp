# The same scale on both axes, whose frame has the size that style.gp gave it: what is flat lies in its middle.
# shape_ratio, height over width of the shapes with a margin, was known to style.gp.
set xrange [(1.02*box_left - 0.02*box_right)*length:(1.02*box_right - 0.02*box_left)*length]
half_range = 0.52*(box_right - box_left)*length*max(shape_ratio, height*(top - bottom)/(600*(right - left)))
set yrange [(box_bottom + box_top)/2*length - half_range:(box_bottom + box_top)/2*length + half_range]
load 'same_scale.gp'
