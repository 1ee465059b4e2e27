# The numbers of at most eight frames, evenly in time: `snapshots`.
snapshots = ''
near = 1
_distance(k, t) = k > frames ? 1e300 : abs(frame_time[k] - t)
do for [k=0:7] {
  wanted = begin + (end - begin)*k/7.0
  while (_distance(near + 1, wanted) < _distance(near, wanted)) { near = near + 1 }
  if (words(snapshots) == 0 || near != word(snapshots, words(snapshots)) + 0) { snapshots = snapshots.sprintf('%d ', near) }
}
