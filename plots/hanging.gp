# A pouch hangs in pictures: along its films, x, is downwards, its films are side by side, and each has an electrode on its
# upper part, up to node electrode_end. Where a point of a shape is drawn: drawn_x(x, y), drawn_y(x, y).
hanging = actuator_kind eq 'pouch' ? 1 : 0
drawn_x(x, y) = hanging ? y : x
drawn_y(x, y) = hanging ? -x : y
electrode_end = hanging ? pouch_electrode_length/ribbon_length*(nodes - 1) + 1e-6 : -1
electrode_y(k) = column(4) <= electrode_end ? drawn_y(column(x_of(k)), 0) : NaN
