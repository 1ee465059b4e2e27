# Electric field where the ribbons part.
title = 'Electric field where the ribbons part'
data = 'field_tip.dat'
load 'of_field.gp'
