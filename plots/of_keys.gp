# Bars for keys: key_name[1] is on top. A bar of row n is between n + low and n + high.
set lmargin at screen 0.29
set style fill solid noborder
set ytics () font ',12'
keys = |key_name|
do for [k=1:keys] { set ytics add (key_name[k] keys - k + 1) }
set yrange [0.4:keys + 0.6]
