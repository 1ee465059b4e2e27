# Our plain comments for Doxygen: the first says what the file is, one before a declaration belongs to it, one behind
# a member to that member.
1s#^/\*#/** @file\n *#
s#^( *)/\* #\1/** #
s#([;,{]|[A-Z0-9_]) +/\* #\1 /**< #
