#!/usr/bin/env python3
"""Bounds of tests that are far wider than what is measured: wide-bounds.py RECORD... [--times N] [--all]

The tests write a RECORD where ZIPACT_CHECKS names it (tests/check_util.h): ZIPACT_CHECKS=$PWD/record ctest. Of each place in the sources, and of each
bound there, the worst comparison counts. A bound of 1e-9 and more that is over N times (10) what was measured is listed, and makes the status 1;
smaller ones hold rounding, which differs from compiler to compiler. --all lists every place, the widest first.
"""
import argparse
import fileinput
import math
import sys

ROUNDING = 1e-9
FEW = 16  # more bounds than that in one place are computed there, and count as one


def worst_of(lines):
    """{place: {bound: (measured, bound, test, what is compared)}}, of each bound the worst comparison."""
    places = {}
    for line in lines:
        place, test, value, against, measured, allowed = line.rstrip("\n").split("\t")
        measured, allowed = float(measured), float(allowed)
        if math.isnan(measured):
            measured = 0.0
        bounds = places.setdefault(place, {})
        if allowed not in bounds or measured > bounds[allowed][0]:
            bounds[allowed] = (measured, allowed, test, " and ".join(filter(None, (value, against))))
    return places


def width(check):
    """Of a bound, in what was measured."""
    measured, allowed = check[:2]
    return allowed / measured if measured else math.inf if allowed else 1


def rows_of(places):
    """[(place, check)], the widest first."""
    rows = []
    for place, bounds in places.items():
        checks = bounds.values() if len(bounds) <= FEW else [min(bounds.values(), key=width)]
        rows += [(place, check) for check in checks]
    return sorted(rows, key=lambda row: -width(row[1]))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("record", nargs="+")
    parser.add_argument("--times", type=float, default=10)
    parser.add_argument("--all", action="store_true")
    options = parser.parse_args()
    rows = rows_of(worst_of(fileinput.input(options.record)))
    wide = [row for row in rows if row[1][1] >= ROUNDING and width(row[1]) > options.times]
    for place, check in rows if options.all else wide:
        measured, allowed, test, value = check
        print(f"{place}: {measured:.2g} measured, {allowed:.2g} allowed, {width(check):.2g} times: {test.removesuffix('_fn')}, {value}")
    print(f"{len(wide)} of {len(rows)} bounds are over {options.times:g} times what was measured")
    return bool(wide)


if __name__ == "__main__":
    sys.exit(main())
