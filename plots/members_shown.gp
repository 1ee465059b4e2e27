# What is `shown` of the members of a network, and its columns `of_members`: openings, or closed lengths without platforms.
of_members = ''
do for [name in members_named] { of_members = of_members.name.'.opening_m ' }
shown = present(of_members) eq '' ? 'closed length' : 'opening'
if (shown ne 'opening') { of_members = '' }
do for [name in shown eq 'opening' ? '' : members_named] { of_members = of_members.name.'.zipped_length_m ' }
