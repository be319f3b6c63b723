#!/usr/bin/python3
"""Writes cases/data/well2.csv: a constructed, nearly vertical well with doglegs.

No public survey has this shape, so the well is made up: a hole that drifts around the vertical, is
kicked by four short doglegs, and falls back towards the vertical in between. The seed is fixed:
the same file comes out every time.
"""

import math
import pathlib
import random

SEED = 2254
LENGTH = 2280.0  # m, some way below the bit of the 2254 m string
SPACING = 30.0  # m between stations, about one stand of pipe
VERTICAL = 240.0  # m of vertical hole below the rig
DRIFT = 0.12  # deg, standard deviation of the change of each tilt from station to station
FALL = 700.0  # m over which a tilt falls back to 1/e

# Doglegs: top (m), length (m), turn towards north and towards east (deg).
DOGLEGS = (
    (570, 60, 3.0, 2.0),
    (1080, 90, -5.0, 3.5),
    (1560, 60, 2.0, -5.5),
    (1980, 90, 4.5, 4.0),
)


def dogleg_turn(depth):
    """Turn (north, east, in deg) that the doglegs add over the SPACING below `depth`."""
    north = east = 0.0
    for top, length, turn_north, turn_east in DOGLEGS:
        if top <= depth < top + length:
            north += turn_north * SPACING / length
            east += turn_east * SPACING / length
    return north, east


def stations():
    """Yields measured depth (m), inclination and azimuth (deg)."""
    chance = random.Random(SEED)
    north = east = 0.0
    for k in range(round(LENGTH / SPACING) + 1):
        depth = k * SPACING
        inclination = math.hypot(north, east)
        azimuth = math.degrees(math.atan2(east, north)) % 360.0
        yield depth, inclination, azimuth
        if depth < VERTICAL:
            continue
        turn_north, turn_east = dogleg_turn(depth)
        fall = math.exp(-SPACING / FALL)
        north = north * fall + turn_north + chance.gauss(0.0, DRIFT)
        east = east * fall + turn_east + chance.gauss(0.0, DRIFT)


def main():
    path = pathlib.Path(__file__).resolve().parent.parent / "cases" / "data" / "well2.csv"
    lines = [
        "# Constructed, not measured: written by tools/make_surveys.py, seed %d." % SEED,
        "# Nearly vertical, with doglegs below " + ", ".join("%d m" % d[0] for d in DOGLEGS) + ".",
        "md[m],inclination[deg],azimuth[deg]",
    ]
    lines += ["%g,%.2f,%.2f" % station for station in stations()]
    path.write_text("\n".join(lines) + "\n")
    print(path)


if __name__ == "__main__":
    main()
