"""For all tests."""

import signal

# A shell that runs a program in the background makes it ignore Ctrl-C.
signal.signal(signal.SIGINT, signal.default_int_handler)
