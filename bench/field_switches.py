#!/usr/bin/python3
"""Well 1 with its physics switched one at a time: loads, contact and energy before and under the
weight and torque at the bit.

Finished runs are kept beside the table, so that the same command goes on where a study was
interrupted. What this version does not have yet fails in its row, and the row says why.
"""

import argparse

import field_study
import measure
from confidence import number
from field_study import DEPTH, ROTATION, UNITS, Motion, Times, Variation, friction

WELL_1 = Motion("Well 1", "well1.toml", "drilling", Times({"before": (35, 45), "under": (60, 70)}, 70))
QUICK = Times({"before": (1.5, 2.5), "under": (4, 5)}, 5, rotation=0.5, load=2.6)
# Windows, and the motions of the equilibrium beside them.
WINDOWS = {"before": "rotating", "under": "drilling"}

# A string that rolls along its wall moves with about as much energy sideways as it rotates with, so
# that its kinetic energy is at least twice that of its rotation.
WHIRLS = 1.5

LAMINAR = {"fluid.regime": "laminar"}
NO_MASS = {"fluid.added_mass": False}
NO_CREEP = {"contact.rolling_creep": 0}
# Rows, and the case keys that each sets.
SWITCHES = [
    ("as shipped", {}),
    ("no added mass", NO_MASS),
    ("laminar mud", LAMINAR),
    ("laminar mud, no added mass", LAMINAR | NO_MASS),
    ("no rolling creep", NO_CREEP),
    ("laminar mud, no rolling creep", LAMINAR | NO_CREEP),
    ("laminar mud, no added mass, no rolling creep", LAMINAR | NO_MASS | NO_CREEP),
    ("no mud drag on nodes in contact", {"fluid.contact_drag": False}),
    ("drag coefficient 0.8", {"fluid.drag_coefficient": 0.8}),
    ("drag coefficient 0.7", {"fluid.drag_coefficient": 0.7}),
    ("the paper's friction law", {"contact.law": "paper"}),
    ("friction 0.2", friction(0.2)), ("friction 0.4", friction(0.4)),
]


def whirling(results, window):
    """How many of the starts whirl."""
    return sum(result["windows"][window][ROTATION]["mean"] > WHIRLS
               for result in results if "failed" not in result)


def text_of(rows):
    """A row for RESULTS.md, from those of the two windows."""
    text = {"": rows[0]["switch"], "starts": field_study.starts_text(rows[0])}
    for quantity in ("hook load", "torque"):
        for row in rows:
            name = f"{quantity} {row['window']} ({UNITS[quantity]})"
            text[name] = field_study.mean_text(row, quantity)
    under = rows[-1]
    text["in contact (%)"] = field_study.mean_text(under, "in contact")
    text["deepest in the wall (mm)"] = number(max(row[f"{DEPTH}, most"] for row in rows), 2)
    text["kinetic energy over rotation"] = field_study.mean_text(under, ROTATION)
    text["whirl"] = f"{under['whirling']} of {under['starts']}"
    return text


def main():
    """Runs what is not yet kept, writes CSV and, if asked, RESULTS.md."""
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    field_study.add_options(parser)
    options = parser.parse_args()

    study = field_study.Study(options, QUICK)
    variations = [Variation(name, settings) for name, settings in SWITCHES]
    found = study.all_numbers([WELL_1], variations)
    pairs = []
    for variation in variations:
        results = found[WELL_1.name, variation.name]
        pairs.append([field_study.row_of({"switch": variation.name, "window": window}, results,
                                         study.static(WELL_1, variation, word), window)
                      | {"whirling": whirling(results, window)}
                      for window, word in WINDOWS.items()])
    study.write("field_switches", [row for pair in pairs for row in pair])
    table = measure.markdown([text_of(pair) for pair in pairs])
    print(table)
    if options.publish:
        before, under = WELL_1.times.windows.values()
        measure.publish(
            "field-switches", study.facts,
            f"{study.remark}`cases/well1.toml` with some of its physics switched: means over "
            f"{before[0]} to {before[1]} s (before) and {under[0]} to {under[1]} s (under 65 kN and "
            "10 kN m), with their 95 % confidence from independent starts. Contact and kinetic "
            "energy are those under load, the depth in the wall is the largest of both windows and "
            "all starts. Starts with more than 1.5 times the kinetic energy of pure rotation whirl.",
            table)


if __name__ == "__main__":
    main()
