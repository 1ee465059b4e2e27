# The numbers of at most `most` frames, evenly in time: `snapshots`.
snapshots = ''
near = 1
most = min(most, frames)
_distance(k, t) = k > frames ? 1e300 : abs(frame_time[k] - t)
do for [k=1:most] {
  wanted = begin + (end - begin)*(k - 1)/max(1.0, most - 1)
  while (_distance(near + 1, wanted) < _distance(near, wanted)) { near = near + 1 }
  if (words(snapshots) == 0 || near != word(snapshots, words(snapshots)) + 0) { snapshots = snapshots.sprintf('%d ', near) }
}
