# Lines of `members` members. Many of them run from blue to red, and the key names only some.
members_many = members > 8
members_each = members_many ? ceil((members - 1)/7.0) : 1
member_colour(k) = members_many ? sprintf('#%06x', hsv2rgb(0.62*(members - k)/(members - 1.0), 0.85, 0.75)) : colour(k)
member_dash(k) = members_many ? 1 : dash(k)
member_named(k, name) = (k - 1) % members_each == 0 || k == members ? name : ''
member_title(k) = member_named(k, sprintf('member %d', k))
