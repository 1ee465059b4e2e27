# The same scale on both axes, whose frame has the size that style.gp gave it: what is flat lies in its middle.
# shape_ratio, height over width of the shapes with a margin, was known to style.gp.
frame_ratio = height*(top - bottom)/(600*(right - left))
half_wide = 0.52*(box_right - box_left)*length
half_range = half_wide*max(shape_ratio, frame_ratio)
if (hanging) { half_wide = half_range/frame_ratio }
set xrange [(box_left + box_right)/2*length - half_wide:(box_left + box_right)/2*length + half_wide]
set yrange [(box_bottom + box_top)/2*length - half_range:(box_bottom + box_top)/2*length + half_range]
load 'same_scale.gp'
