#!/usr/bin/python3
"""Well 1 with its physics switched one at a time: loads, contact and energy before and under the
weight and torque at the bit.

Finished runs are kept beside the table, so that the same command goes on where a study was
interrupted. What this version does not have yet fails in its row, and the row says why.
"""

import argparse

import field_study
import measure
from field_study import ROTATION, UNITS, Motion, Times, Variation, friction

WELL_1 = Motion("Well 1", "well1.toml", "drilling", Times({"before": (35, 45), "under": (60, 70)}, 70))
QUICK = Times({"before": (1.5, 2.5), "under": (4, 5)}, 5, rotation=0.5, load=2.6)
# Windows, and the motions of the equilibrium beside them.
WINDOWS = {"before": "rotating", "under": "drilling"}

# Rows, and the case keys that each sets.
SWITCHES = [
    ("as shipped", {}),
    ("laminar fluid", {"fluid.regime": "laminar"}),
    ("inertial fluid", {"fluid.regime": "inertial"}),
    ("no added mass", {"fluid.added_mass": False}),
    ("added mass", {"fluid.added_mass": True}),
    ("no rolling creep", {"contact.rolling_creep": 0}),
    ("rolling creep 0.005", {"contact.rolling_creep": 0.005}),
    ("Coulomb's friction", {"contact.law": "coulomb"}),
    ("the paper's friction", {"contact.law": "paper"}),
    ("friction 0.2", friction(0.2)), ("friction 0.4", friction(0.4)),
    ("friction 0.6", friction(0.6)),
]


def text_of(rows):
    """A row for RESULTS.md, from those of the two windows."""
    text = {"": rows[0]["switch"], "starts": field_study.starts_text(rows[0])}
    for row in rows:
        window = row["window"]
        for quantity in ("hook load", "torque"):
            text[f"{quantity} {window} ({UNITS[quantity]})"] = field_study.mean_text(row, quantity)
            text[f"{quantity} {window}: static; over it"] = field_study.static_text(row, quantity)
        text[f"in contact {window} (%)"] = field_study.mean_text(row, "in contact")
        text[f"kinetic energy {window}"] = field_study.mean_text(row, ROTATION)
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
    pairs = [[field_study.row_of({"switch": variation.name, "window": window},
                                 found[WELL_1.name, variation.name],
                                 study.static(WELL_1, variation, word), window)
              for window, word in WINDOWS.items()] for variation in variations]
    study.write("field_switches", [row for pair in pairs for row in pair])
    table = measure.markdown([text_of(pair) for pair in pairs])
    print(table)
    if options.publish:
        before, under = WELL_1.times.windows.values()
        measure.publish(
            "field-switches", study.facts,
            f"{study.remark}Well 1 with one thing changed at a time: means over {before[0]} to "
            f"{before[1]} s (before) and {under[0]} to {under[1]} s (under 65 kN and 10 kN m), with "
            "their 95 % confidence from independent starts. Static: `drillstrand equilibrium`, "
            "rotating and drilling. Kinetic energy is that of the string over that of its pure "
            "rotation.", table)


if __name__ == "__main__":
    main()
