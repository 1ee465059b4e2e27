#!/usr/bin/env python3
"""What scripts/make-validity-page.py computes by itself from the results of runs: places where a difference is 1 %, frequencies,
ranges of independent changes, and digits."""
import importlib.util
import math
import os
import sys
import unittest

sys.dont_write_bytecode = True
HOME = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
SPEC = importlib.util.spec_from_file_location("validity", os.path.join(HOME, "scripts", "make-validity-page.py"))
validity = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(validity)


class Numbers(unittest.TestCase):
    def test_one_per_cent_of_a_power_law(self):
        for sign in (1, -1):
            points = [(x, sign * 3e-2 * x ** 1.7) for x in (1, 2, 4, 8, 16)]
            self.assertAlmostEqual(validity.crossing(points), (1 / 3e-2) ** (1 / 1.7), places=12)
        self.assertIsNone(validity.crossing([(1, 0.1), (2, 0.9)]))

    def test_last_crossing_counts(self):
        self.assertAlmostEqual(validity.crossing([(1, 0.5), (2, 2), (3, 0.5), (4, 2)]), 3 * math.sqrt(4 / 3), places=12)

    def test_frequency_of_a_sine(self):
        rows = [{"time_s": t, "stroke_m": 0.01 + 1e-3 * math.sin(2 * math.pi * 3.7 * t + 1)} for t in (k / 2000 for k in range(4000))]
        self.assertAlmostEqual(validity.frequency(rows), 3.7, places=4)

    def test_independent_changes_add_in_squares(self):
        band = validity.Band(20, [((-0.3, 0.2), True), ((0.4, -0.1), False)])
        for name, down, up in (("material", 0.3, 0.2), ("all", math.sqrt(0.1), math.sqrt(0.2))):
            low, high = band.range[name]
            self.assertAlmostEqual(low, 20 * math.exp(-down), places=12)
            self.assertAlmostEqual(high, 20 * math.exp(up), places=12)

    def test_distance_of_a_reading(self):
        class Reading:
            measured = 20 * math.sqrt(1.15)  # half of what two standard deviations are
        self.assertAlmostEqual(validity.Band(20, []).distance(Reading), 1, places=12)

    def test_two_digits_of_a_difference(self):
        self.assertEqual([validity.per_cent(validity.off(a, 100)) for a in (101.234, 99.95432, 66.1, 100.00001)],
                         ["+1.2 %", "−0.046 %", "−34 %", "+0.0000 %"])
        self.assertEqual(validity.per_cent(None), "–")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
