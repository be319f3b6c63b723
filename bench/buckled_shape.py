"""How a string in a straight hole is buckled: straight, sinusoidal or helical, stretch by stretch.

What decides is the azimuth of the pipe in its hole, the angle around the well's axis, counted from
the low side (or from any direction in a vertical well) and followed without jumps along the string.
Between two turning points of the azimuth the string winds one way: a helix where it goes around by
a full turn or more, one half wave of a snake where it goes less far.
"""

from dataclasses import dataclass, field

import numpy as np

STRAIGHT, SINUSOIDAL, HELICAL = "straight", "sinusoidal", "helical"

# A swing of the azimuth below this is noise or sag, not a wave (rad).
LEAST_SWING = np.radians(5)


@dataclass
class Sweep:
    """A stretch on which the azimuth goes one way: nodes first to last, both included."""
    first: int
    last: int
    kind: str
    angle: float  # by how much it goes (rad), with sign


@dataclass
class Shape:
    """The shape of a string. Lengths in m, angles in rad."""
    azimuth: np.ndarray  # per node
    sweeps: list[Sweep]
    share: dict[str, float] = field(default_factory=dict)  # of the length looked at, per kind
    turns: float = 0  # of all helices, whichever way they wind
    net_turns: float = 0  # those one way less those the other way
    reversals: int = 0  # changes of hand from one helix to the next
    pitch: float | None = None  # of the helices, away from their ends
    wavelength: float | None = None  # of the snakes
    amplitude: float | None = None  # half the swing of the snakes


def azimuth_along(lateral):
    """Angle of the rows of (toward the reference, across it), without jumps (rad)."""
    return np.unwrap(np.arctan2(lateral[:, 1], lateral[:, 0]))


def turning_points(angle, least):
    """Indices of the ends and of all turning points whose swing is at least `least` on both
    sides."""
    points = [0]
    direction = 0
    low = high = 0
    for k, value in enumerate(angle):
        if value > angle[high]:
            high = k
        if value < angle[low]:
            low = k
        if direction >= 0 and angle[high] - value >= least:
            if direction > 0 or high > points[-1]:
                points.append(high)
            direction, low = -1, k
            high = k
        elif direction <= 0 and value - angle[low] >= least:
            if direction < 0 or low > points[-1]:
                points.append(low)
            direction, high = 1, k
            low = k
    points.append(len(angle) - 1)
    return sorted(set(points))


def pitch_of(s, angle, sweep):
    """Pitch of a helix from the slope of its azimuth, without half a turn at each end (m); None
    where less than a turn is left."""
    part = slice(sweep.first, sweep.last + 1)
    way = np.abs(angle[part] - angle[sweep.first])
    inside = (way > np.pi) & (way < abs(sweep.angle) - np.pi)
    if abs(sweep.angle) < 4 * np.pi or np.count_nonzero(inside) < 3:
        return None
    return float(2 * np.pi / abs(np.polyfit(s[part][inside], angle[part][inside], 1)[0]))


def describe(s, lateral, looked_at):
    """The shape of nodes at arc length `s` with displacements `lateral` from the well's axis, on
    the nodes that `looked_at` marks (those near the wall, away from supports). The rest counts as
    straight."""
    angle = azimuth_along(lateral)
    shape = Shape(angle, [], {STRAIGHT: 1.0, SINUSOIDAL: 0.0, HELICAL: 0.0})
    nodes = np.flatnonzero(looked_at)
    if len(nodes) < 3:
        return shape
    begin, end = nodes[0], nodes[-1]
    points = begin + np.array(turning_points(angle[begin:end + 1], LEAST_SWING))
    for first, last in zip(points[:-1], points[1:]):
        swing = float(angle[last] - angle[first])
        kind = (HELICAL if abs(swing) >= 2 * np.pi else
                SINUSOIDAL if abs(swing) >= LEAST_SWING else STRAIGHT)
        shape.sweeps.append(Sweep(int(first), int(last), kind, swing))

    length = s[-1] - s[0]
    for kind in (SINUSOIDAL, HELICAL):
        shape.share[kind] = float(sum(s[w.last] - s[w.first] for w in shape.sweeps
                                      if w.kind == kind) / length)
    shape.share[STRAIGHT] = max(0.0, 1 - shape.share[SINUSOIDAL] - shape.share[HELICAL])

    helices = [w for w in shape.sweeps if w.kind == HELICAL]
    shape.turns = sum(abs(w.angle) for w in helices) / (2 * np.pi)
    shape.net_turns = sum(w.angle for w in helices) / (2 * np.pi)
    shape.reversals = sum(one.angle * other.angle < 0 for one, other in zip(helices, helices[1:]))
    pitches = [(pitch, s[w.last] - s[w.first]) for w in helices
               if (pitch := pitch_of(s, angle, w)) is not None]
    if pitches:
        total = sum(length for _, length in pitches)
        shape.pitch = sum(pitch * length for pitch, length in pitches) / total

    # half waves with a turning point at both ends
    waves = [w for w in shape.sweeps[1:-1] if w.kind == SINUSOIDAL]
    if len(waves) > 1:
        shape.wavelength = float(2 * np.median([s[w.last] - s[w.first] for w in waves]))
        shape.amplitude = float(np.median([abs(w.angle) for w in waves]) / 2)
    return shape


def helix_contact(axial_force, bending_stiffness, clearance):
    """Force per length of the wall on a helix, r F^2 / (4 EI) (Lubinski; N/m)."""
    return clearance * np.square(axial_force) / (4 * bending_stiffness)


def helix_pitch(axial_force, bending_stiffness):
    """Pitch of a helix without twist moment, sqrt(8 pi^2 EI / F) (Lubinski; m)."""
    return np.sqrt(8 * np.pi**2 * bending_stiffness / axial_force)


def vertical_turns(force, bending_stiffness, weight):
    """Turns of a helix that hangs in a vertical well, F^1.5 / (3 pi w sqrt(2 EI)): the integral of
    1 / pitch from the bit to the neutral point."""
    return force**1.5 / (3 * np.pi * weight * np.sqrt(2 * bending_stiffness))


def horizontal_limits(bending_stiffness, weight, clearance):
    """Critical loads of a string that lies in a level well (N), with S = sqrt(EI w / r)."""
    unit = np.sqrt(bending_stiffness * weight / clearance)
    return {"sinusoidal 2 S (Dawson, Paslay 1984)": 2 * unit,
            "helical 2.83 S (Chen, Lin, Cheatham 1990)": np.sqrt(8) * unit,
            "helical 3.66 S (Wu, Juvkam-Wold 1993)": 2 * (np.sqrt(8) - 1) * unit,
            "helical 3.75 S (Miska et al. 1996)": 3.75 * unit,
            "only helical 5.66 S (Mitchell 1997)": np.sqrt(32) * unit}


def vertical_limits(bending_stiffness, weight):
    """Critical loads of a string that hangs in a vertical well (N), with its length m =
    (EI / w)^(1/3)."""
    unit = weight * (bending_stiffness / weight) ** (1 / 3)
    return {"first order 1.94 w m (Lubinski 1950)": 1.94 * unit,
            "second order 3.75 w m (Lubinski 1950)": 3.75 * unit,
            "helical 5.55 w m (Wu, Juvkam-Wold 1993)": 5.55 * unit}
