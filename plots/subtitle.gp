# Under which load, voltage and so on the results of a study are, but for list keys, which the legend has: `subtitle`.
if (!exists('single')) single = !exists('lists') || lists eq ''
_swept(k) = strstrt(' '.lists, ' '.k) > 0
_told(before, k) = _swept(k) || (k eq 'load.mass' && exists('bodies_named')) || (k[1:6] eq 'drive.' && actuator_kind eq 'ribbon') ? '' : before.said(of('said_', k)).', '
_up_to = single ? 'up to ' : ''
_drive(w) = w eq 'table' ? 'table of voltages, ' : _told(w eq 'ramp' ? 'ramp to ' : w eq 'sine' ? 'sine to ' : w eq 'square' ? 'square wave to ' : '', 'drive.voltage')
_under(s) = s eq 'stationary' || s eq 'modes' ? _told("load ", 'load.mass') \
          : s eq 'actuate' ? _told("load ", 'load.mass')._drive(drive_waveform) \
          : s eq 'cycle' ? _told("load ", 'load.mass')._drive(drive_waveform)._told(single ? 'at ' : '', 'drive.frequency') \
          : s eq 'equilibrium' ? _told("load ", 'load.mass')._told(_up_to, 'drive.voltage') \
          : s eq 'limits' ? (single || exists('objectives') ? _told("load ", 'load.mass') : '')._told(_up_to, 'drive.voltage') \
          : s eq 'isometric' ? (actuator_kind eq 'pouch' ? _told('held at a strain of ', 'isometric.strain') : _told('held at ', 'isometric.separation'))._told(_up_to, 'drive.voltage') \
          : s eq 'profile' ? _told('opening ', 'isometric.separation')._told('', 'drive.voltage')._told('shape ', 'profile.shape') : ''
_network = exists('bodies_named') ? sprintf('%d %s, %d %s, ', words(bodies_named), words(bodies_named) == 1 ? 'body' : 'bodies', words(members_named), words(members_named) == 1 ? 'member' : 'members') : ''
_pouches = !exists('actuator_kind') ? '' : actuator_kind eq 'pouch' && pouch_count > 1 ? sprintf('one of %d pouches, ', pouch_count) : ''
_all(s) = _pouches._network._under(s).(s eq 'profile' && profile_shape ne 'held' ? '' : (actuator_kind eq 'plate' ? '' : _told('N = ', 'mesh.nodes'))).(preset eq 'none' ? '' : _told('preset ', 'preset'))
_short(s) = s[1:strlen(s) - 2]
if (!exists('subtitle')) subtitle = _short(_all(study))
