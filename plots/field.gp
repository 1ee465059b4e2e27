# Electric field around the ribbons.
title = 'Electric field around the ribbons, left half'
data = 'field.dat'
load 'of_field.gp'
