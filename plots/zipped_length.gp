#picture zipped_length.svg one motion >zipped_length_m opening_m
# Closed length of one run over time.
title = 'Closed length from the clip, one half, over time'
load 'note.gp'
load 'over_time.gp'
load 'zip_mark.gp'
load 'zip_name.gp'
list = 'zipped_length_m'
titles = '"zipped length"'
quantity = 'zipped length'
si = 'm'
sized = list
load 'curves.gp'
