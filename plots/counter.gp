# The counter electrode of one ribbon: `counter` is 1 if there is one, with a face of height counter_face(x) and as many
# points as the ribbon has nodes, eq. (35.1).
counter = actuator_kind eq 'flange' || actuator_kind eq 'curved' ? 1 : 0
counter_face(x) = electro_gap_offset + counter_height*(x/ribbon_length)**counter_power
counter_x(node) = node == node ? node*ribbon_length/(nodes - 1) : NaN
