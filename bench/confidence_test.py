"""Tests of confidence.py: `python3 -m unittest discover -s bench -p '*_test.py'`."""

import math
import unittest

import numpy as np

import confidence


class StudentsT(unittest.TestCase):
    def test_quantiles_are_those_of_the_tables(self):
        # two-sided 95 %: any textbook's table
        for freedom, quantile in [(1, 12.706), (2, 4.303), (3, 3.182), (7, 2.365), (30, 2.042),
                                  (1000, 1.962)]:
            self.assertAlmostEqual(confidence.student_t(freedom), quantile, delta=6e-4)
        self.assertAlmostEqual(confidence.student_t(10, 0.99), 3.169, delta=6e-4)


class Intervals(unittest.TestCase):
    def test_hold_the_true_mean_as_often_as_they_say(self):
        random = np.random.default_rng(1)
        hits = 0
        for values in random.normal(5, 2, (4000, 4)):
            mean, half = confidence.interval(values)
            hits += abs(mean - 5) <= half
        self.assertAlmostEqual(hits / 4000, 0.95, delta=0.015)

    def test_of_differences_too_where_spreads_differ(self):
        random = np.random.default_rng(2)
        hits = 0
        for _ in range(4000):
            change, half = confidence.difference(random.normal(5, 2, 8), random.normal(6, 0.3, 5))
            hits += abs(change - 1) <= half
        self.assertAlmostEqual(hits / 4000, 0.95, delta=0.015)

    def test_by_hand(self):
        mean, half = confidence.interval([1, 2, 3])  # deviation 1, t = 4.303
        self.assertEqual(mean, 2)
        self.assertAlmostEqual(half, 4.3027 / math.sqrt(3), delta=1e-3)
        change, half = confidence.difference([1, 2, 3], [2, 3, 4])  # equal spreads: 4 degrees
        self.assertEqual(change, 1)
        self.assertAlmostEqual(half, 2.7764 * math.sqrt(2 / 3), delta=1e-3)

    def test_of_too_few_values_are_unknown(self):
        self.assertTrue(math.isnan(confidence.interval([1.0])[1]))
        self.assertTrue(math.isnan(confidence.interval([])[0]))
        self.assertTrue(math.isnan(confidence.difference([1.0], [1.0, 2.0])[1]))
        self.assertEqual(confidence.difference([1.0, 1.0], [3.0, 3.0]), (2.0, 0.0))


class Samples(unittest.TestCase):
    def test_a_sine_has_its_spread_and_limits(self):
        values = 3 + 2 * np.sin(np.linspace(0, 2 * np.pi, 100001)[:-1])
        found = confidence.describe(values)
        self.assertAlmostEqual(found["mean"], 3)
        self.assertAlmostEqual(found["spread"], math.sqrt(2))
        self.assertAlmostEqual(found["high"], 3 + 2 * math.sin(0.45 * math.pi), places=4)
        self.assertAlmostEqual(found["low"], 3 - 2 * math.sin(0.45 * math.pi), places=4)


class Words(unittest.TestCase):
    def test_show_the_digits_that_are_known(self):
        self.assertEqual(confidence.with_confidence(198.4042, 0.1234), "198.40 ± 0.12")
        self.assertEqual(confidence.with_confidence(198.4042, 12.34), "198 ± 12")
        self.assertEqual(confidence.with_confidence(0.5, 0.25, "+"), "+0.50 ± 0.25")
        self.assertEqual(confidence.with_confidence(198.4042, math.nan), "198.4")
        self.assertEqual(confidence.with_confidence(math.nan, math.nan), "")


if __name__ == "__main__":
    unittest.main()
