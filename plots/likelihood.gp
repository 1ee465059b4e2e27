#picture likelihood.svg one fit :likelihood
# For each fitted parameter: by how much the sum of squares rises where it is held and the others are fitted again, the level
# of 95 of 100, where the interval ends, and the parabola of the standard error. Between the points that were computed the
# root of the rise is interpolated: next to the best value by parabolas that leave it as that of the standard error does, if
# these only rise; otherwise by lines.
listed = likelihood_columns
skipped = 3
load 'of_parameters.gp'
title = 'Likelihood of the fitted values'
panels = parameters
load 'grid.gp'
array off[300]
array root[300]
_is(v) = v == v
# the signed root of the rise d beside the best value, between it and point i, and between points i and i + 1
_near(d, i) = root[i]/off[i] > 0.5/error ? d/error + (root[i]/off[i] - 1/error)*d*d/off[i] : d*root[i]/off[i]
_line(d, i) = root[i] + (root[i + 1] - root[i])*(d - off[i])/(off[i + 1] - off[i])
_between(d, i) = off[i + 1] == 0 ? _near(d, i) : off[i] == 0 ? _near(d, i + 1) : _line(d, i)
_seek(d, i) = i >= points ? NaN : d <= off[i + 1] ? _between(d, i) : _seek(d, i + 1)
rise_at(d) = points < 2 || d < off[1] || d > off[points] ? NaN : _seek(d, 1)**2
do for [k=1:panels] {
  best = best_of(k)
  error = error_of(k)
  points = 0
  _keep(d, r) = (points = points < 300 ? points + 1 : points, off[points] = d, root[points] = d < 0 ? -r : r, 1)
  set datafile separator ','
  stats '../likelihood.csv' using (column('held') == k ? _keep(column(parameter(k)) - best, sqrt(max(column('rise'), 0))) : NaN) nooutput
  reach = _is(error) ? 2.5*error : 0.1*abs(best) # on a side without points
  least = min(off[1] < 0 ? off[1] : -reach, _is(low_of(k)) ? low_of(k) - best : 0)
  most = max(off[points] > 0 ? off[points] : reach, _is(high_of(k)) ? high_of(k) - best : 0)
  load 'panel.gp'
  f = factor_of(k)
  set xrange [(best + 1.25*least)*f:(best + 1.25*most)*f]
  set yrange [0:1.6*rise_95]
  set xtics step(1.25*(most - least)*f, tics)
  set ytics step(1.6*rise_95, 5)
  set xlabel parameter_label(k) font ',12' offset 0,0.5
  set ylabel 'rise of the squares / σ²' font ',12' offset 0.5
  unset arrow
  if (_is(low_of(k))) { set arrow from low_of(k)*f, 0 to low_of(k)*f, rise_95 nohead lw 1.5 lc rgb colour(3) }
  if (_is(high_of(k))) { set arrow from high_of(k)*f, 0 to high_of(k)*f, rise_95 nohead lw 1.5 lc rgb colour(3) }
  set samples 400
  plot rise_95 with lines lw 1.5 dt 6 lc rgb colour(3) title '95 %', \
       ((x/f - best)/error)**2 with lines lw 1.5 dt 2 lc rgb colour(2) title 'standard error', \
       rise_at(x/f - best) with lines lw 2 lc rgb colour(1) title 'profile', \
       '../likelihood.csv' using (column('held') == k ? column(parameter(k))*f : NaN):'rise' with points pt 7 ps 0.6 lc rgb colour(1) notitle
}
unset multiplot
