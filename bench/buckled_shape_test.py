"""Tests of buckled_shape.py: `python3 -m unittest discover -s bench -p '*_test.py'`."""

import unittest

import numpy as np

import buckled_shape
from buckled_shape import HELICAL, SINUSOIDAL, STRAIGHT

CLEARANCE = 0.04  # m
S = np.linspace(0, 400, 801)
EVERYWHERE = np.ones(S.size, dtype=bool)


def on_the_wall(azimuth):
    return CLEARANCE * np.column_stack([np.cos(azimuth), np.sin(azimuth)])


class Describe(unittest.TestCase):
    def test_a_pipe_on_the_low_side_is_straight(self):
        shape = buckled_shape.describe(S, on_the_wall(0.01 * np.sin(S)), EVERYWHERE)
        self.assertEqual(shape.share[STRAIGHT], 1)
        self.assertEqual(shape.turns, 0)

    def test_a_snake_has_its_wavelength_and_amplitude(self):
        shape = buckled_shape.describe(S, on_the_wall(np.radians(60) * np.sin(2 * np.pi * S / 25)),
                                       EVERYWHERE)
        self.assertGreater(shape.share[SINUSOIDAL], 0.99)
        self.assertAlmostEqual(shape.wavelength, 25, delta=1)
        self.assertAlmostEqual(np.degrees(shape.amplitude), 60, delta=1)
        self.assertEqual(shape.reversals, 0)
        self.assertIsNone(shape.pitch)

    def test_a_helix_has_its_turns_and_pitch_whichever_way_it_winds(self):
        for hand in (1, -1):
            # a little gravity: the azimuth runs unevenly
            azimuth = hand * (2 * np.pi * S / 12.5 + 0.1 * np.sin(2 * np.pi * S / 12.5))
            shape = buckled_shape.describe(S, on_the_wall(azimuth), EVERYWHERE)
            self.assertGreater(shape.share[HELICAL], 0.99)
            self.assertAlmostEqual(shape.turns, 32, places=6)
            self.assertAlmostEqual(shape.net_turns, hand * 32, places=6)
            self.assertAlmostEqual(shape.pitch, 12.5, delta=0.05)
            self.assertEqual(shape.reversals, 0)

    def test_a_helix_that_changes_hand_is_counted_in_parts(self):
        azimuth = 2 * np.pi / 12.5 * (150 - np.abs(S - 150))
        shape = buckled_shape.describe(S, on_the_wall(azimuth), EVERYWHERE)
        self.assertEqual(shape.reversals, 1)
        self.assertAlmostEqual(shape.turns, 32, places=6)
        self.assertAlmostEqual(shape.net_turns, 12 - 20, places=6)
        self.assertAlmostEqual(shape.pitch, 12.5, delta=0.01)

    def test_a_mixed_string_has_shares_of_both(self):
        azimuth = np.where(S < 100, 2 * np.pi * S / 12.5, np.sin(2 * np.pi * (S - 100) / 25))
        shape = buckled_shape.describe(S, on_the_wall(azimuth), EVERYWHERE)
        self.assertAlmostEqual(shape.share[HELICAL], 0.26, delta=0.01)
        self.assertAlmostEqual(shape.share[SINUSOIDAL], 0.74, delta=0.01)
        self.assertEqual(shape.reversals, 0)

    def test_what_is_not_looked_at_counts_as_straight(self):
        azimuth = 2 * np.pi * S / 10
        shape = buckled_shape.describe(S, on_the_wall(azimuth), S >= 300)
        self.assertAlmostEqual(shape.turns, 10, places=6)
        self.assertAlmostEqual(shape.share[STRAIGHT], 0.75, delta=1e-9)

    def test_less_than_a_turn_is_no_helix(self):
        shape = buckled_shape.describe(S, on_the_wall(2 * np.pi * 0.95 * S / 400), EVERYWHERE)
        self.assertEqual(shape.turns, 0)
        self.assertEqual(shape.share[HELICAL], 0)


class Formulas(unittest.TestCase):
    """Against hand calculation for EI = 1 and simple loads."""

    def test_turns_are_the_integral_of_one_over_the_pitch(self):
        force, stiffness, weight = 1e5, 1.736e6, 272.4
        from_bit = np.linspace(0, force / weight, 200001)[:-1]
        inverse = 1 / buckled_shape.helix_pitch(force - weight * from_bit, stiffness)
        total = np.sum(inverse) * (from_bit[1] - from_bit[0])
        self.assertAlmostEqual(buckled_shape.vertical_turns(force, stiffness, weight), total,
                               delta=1e-4 * total)

    def test_contact_force_balances_the_wall_on_a_uniform_helix(self):
        # exact: q = (sin b / r) (F tan b - EI sin^3 b / r^2), b the helix angle, here small
        force, stiffness = 1e5, 1.736e6
        angle = 2 * np.pi * CLEARANCE / buckled_shape.helix_pitch(force, stiffness)
        exact = angle / CLEARANCE * (force * angle - stiffness * angle**3 / CLEARANCE**2)
        self.assertAlmostEqual(buckled_shape.helix_contact(force, stiffness, CLEARANCE), exact,
                               delta=1e-9 * exact)

    def test_critical_loads_keep_their_order(self):
        loads = list(buckled_shape.horizontal_limits(1.736e6, 272.4, CLEARANCE).values())
        self.assertEqual(loads, sorted(loads))
        self.assertAlmostEqual(loads[0], 2 * np.sqrt(1.736e6 * 272.4 / CLEARANCE))


if __name__ == "__main__":
    unittest.main()
