"""What the scripts of this folder count: assertions that hold and that do not."""

counts = [0, 0]  # passed, failed


def ok(what, done):
    """Count one assertion; say what it is if it fails."""
    counts[0 if done else 1] += 1
    if not done:
        print("FAILED: " + what)


def finish():
    """Print the last line, "N passed, N failed" => exit status."""
    print("%d passed, %d failed" % tuple(counts))
    return 1 if counts[1] else 0
