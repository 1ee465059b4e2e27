#!/usr/bin/env python3
"""Bounds of tests that are far wider than what is measured: wide-bounds.py RECORD... [--times N] [--all]

The tests write a RECORD where ZIPACT_CHECKS names it (tests/check_util.h): ZIPACT_CHECKS=$PWD/record ctest. Of each place in the sources
the comparison nearest to its bound counts. A bound of 1e-9 and more that is over N times (10) what was measured is listed, and makes the status 1;
smaller ones hold rounding, which differs from compiler to compiler. --all lists every place, the widest first.
"""
import argparse
import fileinput
import math
import sys

ROUNDING = 1e-9


def width(check):
    """Of a bound, in what was measured."""
    measured, allowed = check[:2]
    return allowed / measured if measured > 0 else math.inf if allowed else 1


def nearest_of(lines):
    """[(place, (measured, bound, test, what is compared))], the widest bound first; a number that is none measures nothing."""
    places = {}
    for line in lines:
        place, test, value, against, measured, allowed = line.rstrip("\n").split("\t")
        check = (float(measured), float(allowed), test, " and ".join(filter(None, (value, against))))
        places[place] = min(places.get(place, check), check, key=width)
    return sorted(places.items(), key=lambda row: -width(row[1]))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("record", nargs="+")
    parser.add_argument("--times", type=float, default=10)
    parser.add_argument("--all", action="store_true")
    options = parser.parse_args()
    rows = nearest_of(fileinput.input(options.record))
    wide = [row for row in rows if row[1][1] >= ROUNDING and width(row[1]) > options.times]
    for place, check in rows if options.all else wide:
        measured, allowed, test, value = check
        print(f"{place}: {measured:.2g} measured, {allowed:.2g} allowed, {width(check):.2g} times: {test.removesuffix('_fn')}, {value}")
    print(f"{len(wide)} of {len(rows)} bounds are over {options.times:g} times what was measured")
    return bool(wide)


if __name__ == "__main__":
    sys.exit(main())
