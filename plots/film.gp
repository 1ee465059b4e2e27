# Liquid between the faces of the left half, at times now[k]: an index of the .dat each.
title = 'Liquid between the faces, left half'
foot = note
if (bead) remark = 'a curve ends where the bead does'
letters = 8
load 'style.gp'
load 'of_shapes.gp'
least = film_roughness # between closed faces
set logscale y
set format y '10^{%L}'
set ylabel 'distance of the faces / µm' offset 0.5
plot for [k=1:|now|] 'film.dat' index k-1 using ($1*length):($2-$3 > least ? ($2-$3)*1e6 : least*1e6) with lines lw 2 \
     lc rgb shade((now[k] - begin)/(end - begin)) title sprintf('%.4g %s', now[k]*scale(end, 's'), unit(end, 's'))
