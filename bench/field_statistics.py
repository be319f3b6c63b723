#!/usr/bin/python3
"""Wells 1, 2 and 3, rotating and drilling: which means and spreads depend on mesh, step, integrator,
friction and threads, and how far they lie from the equilibrium of the same motion.

Finished runs are kept beside the table, so that the same command goes on where a study was
interrupted. What converges decides the default mesh and cfl.
"""

import argparse

import numpy as np

import field_study
import measure
from confidence import difference, number, with_confidence
from field_study import UNITS, Motion, Times, Variation, friction, last

OFF_BOTTOM = {"bit.weight": 0, "bit.torque": 0}
# The load of Well 2, since the paper drills no Well 3.
ON_BOTTOM = {"bit.weight": [[60, 0], [65, "10 kN"]], "bit.torque": [[60, 0], [65, "5 kN m"]]}
MOTIONS = [
    Motion("Well 1, rotating", "well1.toml", "rotating", Times(last(30, 80), 80), OFF_BOTTOM),
    Motion("Well 1, drilling", "well1.toml", "drilling", Times(last(30, 100), 100)),
    Motion("Well 2, rotating", "well2.toml", "rotating", Times(last(30, 120), 120)),
    Motion("Well 2, drilling", "well2_drilling.toml", "drilling", Times(last(30, 150), 150)),
    Motion("Well 3, rotating", "well3.toml", "rotating", Times(last(30, 120), 120)),
    Motion("Well 3, drilling", "well3.toml", "drilling", Times(last(30, 150), 150), ON_BOTTOM),
]

# What dormand-prince can afford. It starts on the axis of the well, and so does its twin.
SHORT = Times(last(10, 24), 24, rotation=2, load=6)
ON_AXIS = {"initial.state": "coaxial"}
VARIATIONS = [
    Variation("N"), Variation("2N", mesh=2), Variation("4N", mesh=4),
    Variation("N, cfl 0.45", {"run.cfl": 0.45}),
    Variation("2N, cfl 0.45", {"run.cfl": 0.45}, mesh=2),
    Variation("friction 0.2", friction(0.2)), Variation("friction 0.4", friction(0.4)),
    Variation("friction 0.6", friction(0.6)),
    Variation("2 threads", threads=2, starts=1),
    Variation("leapfrog, short", ON_AXIS, times=SHORT),
    Variation("dormand-prince, short", ON_AXIS | {"run.integrator": "dormand-prince"}, times=SHORT,
              starts=3, dear=True),
]
# Pairs of variations whose means should agree.
PAIRS = [("N", "4N"), ("2N", "4N"), ("N", "N, cfl 0.45"), ("2N", "2N, cfl 0.45"),
         ("leapfrog, short", "dormand-prince, short")]
QUICK = Times(last(2, 5), 5, rotation=0.5, load=2)


def text_of(row):
    """A row of a motion's table."""
    cells = {"": row["variation"], "starts": field_study.starts_text(row)}
    for quantity, unit in UNITS.items():
        spread, low, high = (number(row[f"{quantity}, {name}"], 3)
                             for name in ("spread", "low", "high"))
        cells[f"{quantity} ({unit})"] = field_study.mean_text(row, quantity)
        cells[f"{quantity}: spread; 5 to 95 %"] = f"{spread}; {low} to {high}" if spread else ""
        cells[f"{quantity}: static; over it"] = field_study.static_text(row, quantity)
    return cells | {"wall s per s": number(row["wall s per s"], 2)}


def tables_of(rows):
    """The rows of a motion that were run, and which were not."""
    done = [row for row in rows if row["starts"] or row["failed"]]
    left = [row["variation"] for row in rows if row not in done]
    table = [measure.markdown([text_of(row) for row in done])] if done else []
    return table + ([f"Not run yet: {'; '.join(left)}."] if left else [])


def means_of(results, quantity):
    return [result["windows"]["last"][quantity]["mean"] for result in results
            if "failed" not in result]


def change_text(first, second, quantity):
    """By how much a mean changes, in per cent of the first; bold where that is no accident."""
    before, after = means_of(first, quantity), means_of(second, quantity)
    if not before or not after or np.mean(before) == 0:
        return ""
    change, half = difference(before, after)
    scale = 100 / abs(np.mean(before))
    text = with_confidence(scale * change, scale * half, "+")
    return f"**{text}**" if abs(change) > half else text


def changes(found, motions):
    """What finer meshes, shorter steps and the other integrator change."""
    return [{"": motion.name, "from": first, "to": second,
             **{f"{quantity} (%)": change_text(found[motion.name, first],
                                               found[motion.name, second], quantity)
                for quantity in UNITS}}
            for motion in motions for first, second in PAIRS
            if found.get((motion.name, first)) and found.get((motion.name, second))]


def threads_text(found, motions):
    """Whether one and two threads gave the same series; empty where that was not asked."""
    pairs = [(found.get((motion.name, "N")), found.get((motion.name, "2 threads")))
             for motion in motions]
    equal = [one[0].get("digest") == two[0].get("digest") for one, two in pairs if one and two]
    if not equal:
        return ""
    return f"Series on one and on two threads are {'equal bit for bit' if all(equal) else 'DIFFERENT'}."


def main():
    """Runs what is not yet kept, writes CSV and, if asked, RESULTS.md."""
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    field_study.add_options(parser)
    names = [variation.name for variation in VARIATIONS]
    parser.add_argument("--motion", default="", help="only motions with this in their names: \"Well 1\"")
    parser.add_argument("--variation", action="append", choices=names, metavar="ROW",
                        help=f"only this row; may be repeated: {'; '.join(names)}")
    options = parser.parse_args()

    study = field_study.Study(options, QUICK)
    variations = [variation for variation in VARIATIONS
                  if variation.name in (options.variation or names)]
    motions = [motion for motion in MOTIONS if options.motion in motion.name]
    found = study.all_numbers(motions, variations)
    rows, parts = [], []
    for motion in motions:
        of_motion = [field_study.row_of({"motion": motion.name, "variation": variation.name},
                                        found[motion.name, variation.name],
                                        study.static(motion, variation, motion.word))
                     for variation in variations]
        rows += [row for row in of_motion if row["starts"] or row["failed"]]
        parts += [f"**{motion.name}**", *tables_of(of_motion)]
    changed = changes(found, motions)
    if changed:
        parts += ["What changes, with its confidence; bold where that is no accident of the starts:",
                  measure.markdown(changed)]
    parts += filter(None, [threads_text(found, motions)])
    study.write("field_statistics", rows)
    print("\n\n".join(parts))
    if options.publish:
        measure.publish(
            "field-statistics", study.facts,
            f"{study.remark}Means over the last 30 s of a run (10 s of the short ones), each with its "
            "95 % confidence from independent starts; spread and limits of 5 and 95 % within a run. "
            "Static: `drillstrand equilibrium` of the same motion, mesh and friction. N: the segments "
            "of the case.", *parts)


if __name__ == "__main__":
    main()
