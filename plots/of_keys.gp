# Bars for keys: key_name[1] is on top. A bar of row n is between n + low and n + high. Loaded before style.gp, which it loads.
load 'functions.gp'
keys = |key_name|
left = 0
do for [k=1:keys] { left = max(left, 0.03 + 0.0115*strlen(key_name[k])) }
load 'style.gp'
# solid(1) ... solid(4): how full the bars of a colour are, which tells them in grey, too
solid(k) = word('1 0.35 0.7 0.15', (k - 1) % 4 + 1) + 0
set ytics () font ',12'
do for [k=1:keys] { set ytics add (escaped(key_name[k]) keys - k + 1) }
set yrange [0.4:keys + 0.6]
