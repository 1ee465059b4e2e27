# A pouch hangs in pictures: along its films is downwards, its films are side by side, and each has an electrode on its
# upper part, up to node electrode_end. The shape of a single one lies, with x along its films. Where a point of a shape is
# drawn: drawn_x(x, y), drawn_y(x, y).
hanging = actuator_kind eq 'pouch' ? 1 : 0
lying = hanging && members < 2
drawn_x(x, y) = lying ? y : x
drawn_y(x, y) = lying ? -x : y
electrode_end = hanging ? pouch_electrode_length/ribbon_length*(nodes - 1) + 1e-6 : -1
_electrode(n) = n == n ? int(n) % nodes <= electrode_end : 0
electrode_y(k) = _electrode(column(4)) ? drawn_y(column(x_of(k)), column(x_of(k) + 1)) : NaN
