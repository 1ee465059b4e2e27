# Do all `members` have the voltage of the top level, as far as a caption can say it: one_voltage?
one_voltage = 1
do for [k=1:members] {
  do for [key in 'port drive_voltage drive_waveform drive_delay drive_frequency control_kind source_model'] {
    if (exists(sprintf('member_%d_%s', k, key))) { one_voltage = 0 }
  }
}
