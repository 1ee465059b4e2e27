# The small print of motions: `foot`.
foot = liquid ne 'none' ? 'times have not been compared with measured ones' \
     : damping_drag > 0 ? 'the only drag is c |v| v on each particle, not that of the liquid: times are not predictions' \
                        : 'the drag of the liquid is not modelled: times are not predictions'
