# Closed length of one run over time.
title = 'Closed length from the clip, one half, over time'
foot = note
load 'over_time.gp'
load 'zip_mark.gp'
load 'zip_name.gp'
list = 'zipped_length_m'
titles = '"zipped length"'
quantity = 'zipped length'
si = 'm'
sized = list
load 'curves.gp'
