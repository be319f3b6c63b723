#!/usr/bin/python3
"""Reads result files of drillstrand and draws them.

As a script: all figures that the file has data for.

    tools/drillstrand_results.py OUT.h5 -o DIR

As a module (PYTHONPATH=tools): read_result() gives numpy arrays, draw_...() figures of matplotlib.

    import drillstrand_results as results
    result = results.read_result("OUT.h5")          # also while the run goes on
    time, stress = result.series["time"], result.series["head_stress"]
    print(stress.shape, result.units["series/head_stress"], result.attributes["status"])
    results.draw_head_stress(result).savefig("head_stress.png")

Names, shapes and units are those of the file: engine/results/README.md.
"""

import argparse
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np

# Colours of Okabe and Ito, which colour-blind people can tell apart.
BLUE, VERMILLION = "#0072B2", "#D55E00"
GREY = "#666666"

# Components of a stress: name, unit to draw in, size of that unit in SI.
STRESS_COMPONENTS = [("twist moment", "kN m", 1e3), ("bending moment 1", "kN m", 1e3),
                     ("bending moment 2", "kN m", 1e3), ("axial force", "kN", 1e3),
                     ("shear force 1", "kN", 1e3), ("shear force 2", "kN", 1e3)]

# Wells that lean less than this have no high side worth the name; north takes its place.
LEAST_LEAN = np.radians(3)

# A joined line shows an orbit from this many profiles per turn of the string on.
PROFILES_PER_TURN = 8


class UnreadableResult(Exception):
    """The file is not a result of drillstrand run."""


class NothingToDraw(Exception):
    """The file has no data for a figure; the text says what is missing."""


@dataclass
class Result:
    """What a result file held when it was read. The keys are names of datasets without their group,
    but for `units` and `descriptions`, which have it: "series/time"."""
    path: Path
    attributes: dict  # of the root: title, case, status...
    mesh: dict
    string: dict
    well: dict  # empty without a well
    series: dict
    profiles: dict
    cycles: dict  # empty where none were counted
    sensors: dict  # of each sensor's name, what it recorded
    units: dict
    descriptions: dict

    def spin(self):
        """Rate of rotation of the nodes about their axis, profiles x nodes (rad/s)."""
        if "polar_inertia" not in self.string:
            raise NothingToDraw("the file does not hold the string's inertia")
        return self.profiles["momentum"][:, :, 0] / self.string["polar_inertia"]

    def axis_at(self, measured_depth):
        """Points of the well's axis (m, north, east, down) and its unit tangents at measured depths
        (m, any shape): arcs between the stations (minimum curvature), straight beyond them."""
        return _axis_at(self.well, np.asarray(measured_depth, dtype=float))

    def lateral_offset(self, node=slice(None)):
        """Offset of nodes from the axis of the well toward its high side (north in a nearly vertical
        well) and to the right of that, looking down the hole: profiles x nodes x 2 (m)."""
        axis, tangent = self.axis_at(self.profiles["well_depth"][:, node])
        offset = self.profiles["position"][:, node] - axis
        # one reference direction per node: it must not flip from one profile to the next
        lean = np.hypot(tangent[0, ..., 0], tangent[0, ..., 1])
        upright = lean < np.sin(LEAST_LEAN)
        reference = np.where(upright[..., None], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0])
        along = np.sum(reference * tangent, axis=-1, keepdims=True)
        high = reference - along * tangent
        high /= np.linalg.norm(high, axis=-1, keepdims=True)
        right = np.cross(tangent, high)
        return np.stack([np.sum(offset * high, axis=-1), np.sum(offset * right, axis=-1)], axis=-1)

    def clearance(self):
        """Room between pipe and wall with the pipe in the middle, nodes (m), at the depths of the
        last profile."""
        depth = self.profiles["well_depth"][-1]
        ends, diameters = self.well["section_end"], self.well["section_diameter"]
        section = np.minimum(np.searchsorted(ends, depth), len(ends) - 1)
        starts = np.concatenate([self.well["measured_depth"][:1], ends[:-1]])[section]
        share = np.clip((depth - starts) / (ends[section] - starts), 0, 1)
        narrowing = self.well.get("section_end_diameter", diameters) - diameters
        diameter = diameters[section] + share * narrowing[section]
        return 0.5 * diameter - self.string["outer_radius"]


def read_result(path):
    """Reads a result file, also one that is being written. Raises UnreadableResult."""
    attempts = 5
    for attempt in range(attempts):
        try:
            return _read(Path(path))
        except (OSError, KeyError, RuntimeError) as error:
            # the reading may have met the file in the middle of a flush
            missing = not Path(path).is_file()
            if missing or attempt == attempts - 1:
                reason = "there is no such file" if missing else f"cannot read: {error}"
                raise UnreadableResult(f"{path}: {reason}") from error
            time.sleep(0.2)


def _read(path):
    with h5py.File(path, "r") as file:
        if "series/time" not in file:
            raise UnreadableResult(f"{path}: this is no result of drillstrand run")
        units, descriptions = {}, {}

        def read_group(group):
            if group not in file:
                return {}
            # values are in the file before their times, so what has a time has a value
            count = file[group]["time"].shape[0] if "time" in file[group] else None
            values = {}
            for name, data in file[group].items():
                units[f"{group}/{name}"] = data.attrs["units"]
                descriptions[f"{group}/{name}"] = data.attrs["description"]
                values[name] = data[:count]
            return values

        groups = {group: read_group(group)
                  for group in ("mesh", "string", "well", "series", "profiles", "cycles")}
        sensors = {name: read_group(f"sensors/{name}") for name in file.get("sensors", {})}
        return Result(path=path, attributes=dict(file.attrs), units=units, sensors=sensors,
                      descriptions=descriptions, **groups)


def _axis_at(well, depth):
    stations = well["measured_depth"]
    inclination, azimuth = well["inclination"], well["azimuth"]
    tangents = np.stack([np.sin(inclination) * np.cos(azimuth),
                         np.sin(inclination) * np.sin(azimuth), np.cos(inclination)], axis=-1)
    index = np.clip(np.searchsorted(stations, depth, side="right") - 1, 0, len(stations) - 2)
    length = (stations[1:] - stations[:-1])[index][..., None]
    start, first, last = well["position"][index], tangents[index], tangents[index + 1]
    angle = 2 * np.arcsin(np.clip(np.linalg.norm(last - first, axis=-1, keepdims=True) / 2, 0, 1))
    curvature = angle / length
    # the part of the distance that lies between the stations is on the arc, the rest is straight
    distance = (depth - stations[index])[..., None]
    on_arc = np.clip(distance, 0, length)
    toward = last - np.sum(last * first, axis=-1, keepdims=True) * first
    size = np.linalg.norm(toward, axis=-1, keepdims=True)
    normal = np.divide(toward, size, out=np.zeros_like(toward), where=size > 0)
    turned = curvature * on_arc
    tangent = np.cos(turned) * first + np.sin(turned) * normal
    point = start + on_arc * (np.sinc(turned / np.pi) * first
                              + turned / 2 * np.sinc(turned / 2 / np.pi)**2 * normal)
    return point + (distance - on_arc) * tangent, tangent


def _figure(result, what, *shape, size, **options):
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(*shape, figsize=size, layout="constrained", **options)
    figure.suptitle(f"{result.attributes['title']}: {what}", fontsize=11)
    return figure, axes


def _require_profiles(result, well=False):
    if not len(result.profiles.get("time", [])):
        raise NothingToDraw("the file holds no profiles")
    if well and (not result.well or "outer_radius" not in result.string):
        raise NothingToDraw("the file holds no well")


def _limits(values, share=99.5):
    """Where a colour scale ends: a few peaks must not make all the rest one colour."""
    low, high = np.percentile(values, [100 - share, share])
    return (low, high) if high > low else (values.min(), max(values.max(), values.min() + 1e-12))


def _draw_map(figure, axes, time_axis, depth, values, label, limits, cmap="viridis"):
    """Colours over time and depth; says at the colour bar where values lie beyond the scale."""
    mesh = axes.pcolormesh(time_axis, depth, values, shading="nearest", cmap=cmap, vmin=limits[0],
                           vmax=limits[1], rasterized=True)
    beyond = (values.min() < limits[0], values.max() > limits[1])
    extend = {(True, True): "both", (True, False): "min", (False, True): "max"}.get(beyond, "neither")
    figure.colorbar(mesh, ax=axes, label=label, extend=extend)


def draw_head_stress(result):
    """The six stresses of the first segment over time."""
    if len(result.series["time"]) < 2:
        raise NothingToDraw("the file holds no series")
    figure, axes = _figure(result, "stress at the head", 2, 3, size=(12, 6.5), sharex=True)
    for k, (name, unit, size) in enumerate(STRESS_COMPONENTS):
        panel = axes.flat[k]
        panel.plot(result.series["time"], result.series["head_stress"][:, k] / size, color=BLUE,
                   linewidth=0.8)
        panel.set_ylabel(f"{name} ({unit})")
        panel.grid(alpha=0.3)
        panel.margins(x=0)
        if k >= 3:
            panel.set_xlabel("time (s)")
    return figure


def draw_string(result, profile=-1):
    """A profile of the string: its path in space, coloured by the axial force, and in a well how far
    off the axis it lies."""
    from matplotlib import pyplot
    _require_profiles(result)
    in_well = bool(result.well) and "outer_radius" in result.string
    moment = result.profiles["time"][profile]
    figure = pyplot.figure(figsize=(12 if in_well else 7, 6.5), layout="constrained")
    figure.suptitle(f"{result.attributes['title']}: string at {moment:g} s", fontsize=11)
    grid = figure.add_gridspec(1, 3 if in_well else 1,
                               width_ratios=[2.2, 1, 1] if in_well else None)
    _draw_path(result, profile, figure, figure.add_subplot(grid[0], projection="3d"))
    if in_well:
        _draw_offsets(result, profile, figure, [grid[1], grid[2]])
    return figure


def _draw_path(result, profile, figure, axes):
    from mpl_toolkits.mplot3d.art3d import Line3DCollection
    position = result.profiles["position"][profile][:, [1, 0, 2]]  # east, north, down
    force = result.profiles["stress"][profile, :, 3] / 1e3
    lines = Line3DCollection(np.stack([position[:-1], position[1:]], axis=1), array=force,
                             cmap="viridis", linewidth=3, capstyle="round")
    axes.add_collection3d(lines)
    points = position
    if result.well:
        top, bottom = result.well["measured_depth"][[0, -1]]
        deepest = max(bottom, result.profiles["well_depth"][profile].max())
        well = result.axis_at(np.linspace(top, deepest, 400))[0][:, [1, 0, 2]]
        axes.plot(*well.T, color=GREY, alpha=0.3, linewidth=9, label="well (width not to scale)")
        axes.legend(loc="upper right")
        points = np.concatenate([position, well])
    _set_box(axes, points)
    figure.colorbar(lines, ax=axes, label="axial force (kN), tension positive", shrink=0.6, pad=0.12,
                    location="left")


def _set_box(axes, points):
    """One scale for all three directions, but for a side of at least a third of the longest."""
    middle = (points.min(axis=0) + points.max(axis=0)) / 2
    extent = np.ptp(points, axis=0)
    extent = np.maximum(extent, extent.max() / 3) * 1.02
    for k, set_limits in enumerate([axes.set_xlim, axes.set_ylim, axes.set_zlim]):
        set_limits(middle[k] - extent[k] / 2, middle[k] + extent[k] / 2)
    axes.set_box_aspect(extent, zoom=0.9)
    axes.invert_zaxis()
    axes.set(xlabel="east (m)", ylabel="north (m)", zlabel="down (m)")
    for axis in (axes.xaxis, axes.yaxis, axes.zaxis):
        axis.set_major_locator(_few_ticks())
        axis.labelpad = 12
    axes.tick_params(axis="z", pad=14)
    axes.yaxis.labelpad, axes.zaxis.labelpad = 24, 34


def _few_ticks():
    from matplotlib.ticker import MaxNLocator
    return MaxNLocator(4)


def _side_names(result):
    """What the two components of lateral_offset() point to, at most nodes."""
    lean = np.median(np.interp(result.profiles["well_depth"][-1], result.well["measured_depth"],
                               result.well["inclination"]))
    return ("north", "east") if lean < LEAST_LEAN else ("the high side", "the right")


def _draw_offsets(result, profile, figure, places):
    offset = result.lateral_offset()[profile] * 1e3
    clearance = result.clearance() * 1e3
    depth = result.profiles["well_depth"][profile]
    first = None
    for k, (place, side) in enumerate(zip(places, _side_names(result))):
        axes = figure.add_subplot(place, sharey=first)
        axes.fill_betweenx(depth, -clearance, clearance, color=GREY, alpha=0.15, linewidth=0,
                           label="clearance")
        axes.plot(offset[:, k], depth, color=BLUE, linewidth=1)
        axes.set_xlabel(f"offset to {side} (mm)")
        axes.grid(alpha=0.3)
        if first is None:
            first = axes
            axes.set_ylabel("measured depth (m)")
            axes.set_ylim(depth.max(), depth.min())
            axes.legend(loc="lower left", bbox_to_anchor=(0, 1), frameon=False)
        else:
            axes.tick_params(labelleft=False)


def draw_contact(result):
    """Normal force between wall and string over depth and time."""
    _require_profiles(result, well=True)
    force = result.profiles["normal_force"] / 1e3
    if len(force) < 2:
        raise NothingToDraw("the file holds one profile only")
    if force.max() == 0:
        raise NothingToDraw("nothing touches the wall")
    figure, axes = _figure(result, "contact force", size=(9, 5.5))
    depth = result.profiles["well_depth"][-1]
    _draw_map(figure, axes, result.profiles["time"], depth, force.T, "normal force (kN/m)",
              (0, _limits(force[force > 0])[1]))
    axes.set(xlabel="time (s)", ylabel="measured depth (m)")
    axes.invert_yaxis()
    return figure


def liveliest_node(result):
    """The node that moves across the well the most in the second half of the profiles, relative to
    its clearance."""
    late = result.lateral_offset()[len(result.profiles["time"]) // 2:]
    return int(np.argmax(late.std(axis=0).sum(axis=-1) / result.clearance()))


def draw_orbit(result, node=None, duration=10.0):
    """Path of a node across the well during the last `duration` seconds, inside its clearance."""
    _require_profiles(result, well=True)
    moments = result.profiles["time"]
    late = moments >= moments[-1] - duration
    if np.count_nonzero(late) < 3:
        raise NothingToDraw(f"the last {duration:g} s have fewer than three profiles; make more with "
                            "--set output.profile_interval=0.05")
    node = liveliest_node(result) if node is None else node
    offset = result.lateral_offset(node)[late] * 1e3
    depth = result.profiles["well_depth"][-1, node]
    figure, axes = _figure(result, f"orbit at {depth:.0f} m of measured depth", size=(7, 6))
    radius = result.clearance()[node] * 1e3
    angle = np.linspace(0, 2 * np.pi, 361)
    axes.plot(radius * np.cos(angle), radius * np.sin(angle), color=VERMILLION, label="clearance")
    if _profiles_per_turn(result, late) >= PROFILES_PER_TURN:
        axes.plot(offset[:, 1], offset[:, 0], color=GREY, linewidth=0.6)
    else:
        axes.set_title("profiles too far apart in time to be joined", fontsize=9)
    points = axes.scatter(offset[:, 1], offset[:, 0], c=moments[late], cmap="cividis", s=10, zorder=3)
    figure.colorbar(points, ax=axes, label="time (s)")
    high, right = _side_names(result)
    axes.set(xlabel=f"offset to {right} (mm)", ylabel=f"offset to {high} (mm)", aspect="equal")
    axes.legend(loc="upper right")
    axes.grid(alpha=0.3)
    return figure


def _profiles_per_turn(result, late):
    interval = np.diff(result.profiles["time"][late]).max()
    rate = np.abs(result.series["head_rotation_rate"][-1])
    return 2 * np.pi / (rate * interval) if rate > 0 else np.inf


def draw_spectrogram(result, window=12.8):
    """Power of the fluctuations of the torque at the head over time and frequency, in windows of
    `window` seconds, or a quarter of the run where that is less."""
    moments = result.series["time"]
    interval = np.median(np.diff(moments)) if len(moments) > 1 else np.inf
    size = int(min(window / interval, len(moments) / 4))
    if size < 16:
        raise NothingToDraw("the series are too short for a spectrogram")
    from matplotlib import mlab
    uniform = np.arange(moments[0], moments[-1], interval)
    torque = np.interp(uniform, moments, result.series["head_stress"][:, 0]) / 1e3
    power, frequency, centre = mlab.specgram(torque, NFFT=size, Fs=1 / interval,
                                             noverlap=size * 7 // 8, detrend="linear")
    if power.max() == 0:
        raise NothingToDraw("there is no torque")
    level = 10 * np.log10(np.maximum(power, power.max() * 1e-8))
    figure, axes = _figure(result, "fluctuations of the twist moment at the head", size=(9, 5))
    _draw_map(figure, axes, centre + moments[0], frequency, level,
              "power spectral density (dB, of 1 (kN m)²/Hz)", (level.max() - 60, level.max()))
    axes.set(xlabel="time (s)", ylabel="frequency (Hz)")
    return figure


FIGURES = {"head_stress": draw_head_stress, "string": draw_string, "contact": draw_contact,
           "orbit": draw_orbit, "spectrogram": draw_spectrogram}


def write_figures(result, folder, suffix="png"):
    """Writes every figure that the result has data for. Returns their paths, and a text for each
    figure left out."""
    from matplotlib import pyplot
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    paths, left_out = [], []
    for name, draw in FIGURES.items():
        try:
            figure = draw(result)
        except NothingToDraw as reason:
            left_out.append(f"no {name}: {reason}")
            continue
        paths.append(folder / f"{name}.{suffix}")
        figure.savefig(paths[-1], dpi=130)
        pyplot.close(figure)
    return paths, left_out


def main():
    parser = argparse.ArgumentParser(description="Draws a result file of drillstrand run.")
    parser.add_argument("result", metavar="OUT.h5")
    parser.add_argument("-o", "--output", metavar="DIR", default=None,
                        help="folder for the figures; default: OUT's stem, in the working directory")
    parser.add_argument("--format", choices=["png", "pdf", "svg"], default="png")
    options = parser.parse_args()
    import matplotlib
    matplotlib.use("Agg")
    try:
        result = read_result(options.result)
        paths, left_out = write_figures(result, options.output or Path(options.result).stem,
                                        options.format)
    except (UnreadableResult, OSError) as error:
        print(f"drillstrand_results: error: {error}", file=sys.stderr)
        return 2 if isinstance(error, UnreadableResult) else 1
    for text in left_out:
        print(f"drillstrand_results: {text}", file=sys.stderr)
    for path in paths:
        print(path)
    return 0


if __name__ == "__main__":
    sys.exit(main())
