#!/usr/bin/python3
"""Result files that are as small as HDF5 lets them be, for the fuzzer to start from:
make_corpus.py FOLDER"""

import pathlib
import sys

import h5py
import numpy as np

NODES, SEGMENTS = 3, 2
PROFILES = {"position": (NODES, 3), "director": (NODES, 3), "momentum": (NODES, 6),
            "stress": (SEGMENTS, 6), "moment": (NODES, 3), "eccentricity": (NODES,), "well_depth": (NODES,),
            "contact_force": (NODES, 3), "normal_force": (NODES,)}
SERIES = {"head_stress": (6,), "bit_stress": (6,), "head_position": (3,), "bit_position": (3,)}
NUMBERS = ["head_rotation_rate", "bit_rotation_rate", "kinetic_energy", "elastic_energy",
           "potential_energy", "work", "dissipation", "step_size", "time_error", "max_penetration"]
COUNTS = ["contact_nodes", "impacts", "contact_changes", "slips"]
DEPTHS = ["hook_load", "surface_torque", "neutral_point", "soft_hook_load", "soft_surface_torque",
          "standpipe_pressure", "bit_pressure", "equivalent_density", "mud_force"]
ALONG = ["tension", "torque", "side_force", "bending_stress", "von_mises_stress", "sinusoidal_limit",
         "helical_limit", "soft_tension", "soft_torque", "soft_side_force", "inside_pressure",
         "outside_pressure", "true_tension"]

STATIC = {"position": (NODES, 3), "director": (NODES, 3), "side_force": (NODES,)}
MODE_NUMBERS = ["frequency", "lateral_share", "torsional_share", "axial_share", "whirl",
                "bending_place"]
MOTIONS = ["shape", "shape_turn", "later_shape", "later_shape_turn"]
RESPONSE = {"displacement": NODES, "twist": NODES, "side_force": NODES,
            "bending_moment": SEGMENTS, "torque": SEGMENTS, "axial_force": SEGMENTS}


def numbers(*shape):
    return np.linspace(1, 2, int(np.prod(shape, dtype=int))).reshape(shape)


def add_origin(file):
    for name in ["title", "case", "version", "commit", "status"]:
        file.attrs[name] = name


def add_mesh(group):
    group["mesh/node_s"] = [0.0, 10, 20]
    group["mesh/segment_s"] = [5.0, 15]


def add_run(file, records, profiles, **storage):
    add_origin(file)
    file.attrs["integrator"] = "leapfrog"
    for name in ["threads", "steps", "steps_rejected", "evaluations"]:
        file.attrs[name] = np.int64(1)
    for name in ["wall_seconds", "smallest_step", "largest_step", "time_error", "energy_residual"]:
        file.attrs[name] = 0.5
    add_mesh(file)
    file["series/time"] = np.arange(float(records))
    for name, shape in SERIES.items():
        file["series/" + name] = numbers(records, *shape)
    for name in NUMBERS:
        file["series/" + name] = numbers(records)
    for name in COUNTS:
        file["series/" + name] = np.arange(records)
    file["profiles/time"] = np.arange(float(profiles))
    for name, shape in PROFILES.items():
        if storage:
            file.create_dataset("profiles/" + name, data=numbers(profiles, *shape),
                                chunks=(1,) + shape, **storage)
        else:
            file["profiles/" + name] = numbers(profiles, *shape)


def add_scene(file):
    for name in ["cell", "mass", "weight", "outer_radius", "polar_inertia"]:
        file["string/" + name] = numbers(NODES)
    for name in ["metal_area", "yield_tension", "yield_bending", "yield_torque"]:
        file["string/" + name] = numbers(SEGMENTS)
    file["well/measured_depth"] = [0.0, 100, 200]
    file["well/inclination"] = [0.0, 0.1, 0.3]
    file["well/azimuth"] = [0.0, 0.2, 0.2]
    file["well/position"] = numbers(3, 3)
    file["well/section_end"] = [50.0, 200]
    file["well/section_diameter"] = [0.4, 0.3]


def run(file):
    add_run(file, 3, 2)
    add_scene(file)


def run_without_records(file):
    add_run(file, 0, 0)


def run_compressed(file):
    add_run(file, 1, 1, compression=4, shuffle=True)


def buckling(file):
    add_origin(file)
    file.attrs["discretisation"] = "paper"
    add_mesh(file.create_group("buckling"))
    file["buckling/critical_load"] = numbers(2)
    file["buckling/mode_strain"] = numbers(2, SEGMENTS, 6)
    file.create_group("buckling/instability").attrs["load"] = 0.5
    file["buckling/instability/eigenvalue"] = numbers(2)
    file["buckling/instability/strain"] = numbers(2, SEGMENTS, 6)


def torque_drag(file):
    add_origin(file)
    group = file.create_group("torque_drag")
    add_mesh(group)
    group["bit_depth"] = [100.0, 200]
    group["measured_depth"] = numbers(SEGMENTS)
    for name in DEPTHS:
        group["drilling/" + name] = numbers(2)
    for name in ALONG:
        group["drilling/profile/" + name] = numbers(SEGMENTS)
    group["drilling/buckling"] = np.array([-1, 2])
    for name in ["lock_up_depth", "largest_weight"]:
        group["drilling"].attrs[name] = 0.5
    group["drilling/profile/buckling"] = np.array([0, 1])


def add_points(group, names, kinds):
    for name in names:
        group[name] = numbers(len(kinds))
    group["kind"] = np.array(kinds)


def modes(file):
    add_origin(file)
    group = file.create_group("modes")
    group.attrs["rotation_rate"] = 0.5
    group.attrs["sticks"] = np.int64(1)
    add_mesh(group)
    for name, shape in STATIC.items():
        group["static/" + name] = numbers(*shape)
    add_points(group, MODE_NUMBERS, [0, 2])
    group["crossings"] = np.arange(2)
    for name in MOTIONS:
        group[name] = numbers(2, NODES, 3)
    add_points(group.create_group("campbell"), ["rotation_rate", "frequency", "whirl"], [1])
    add_points(group.create_group("critical"), ["order", "rotation_rate", "whirl"], [1])
    response = group.create_group("response")
    for name in ["order", "bit_force", "bit_torque"]:
        response.attrs[name] = 0.5
    response.attrs["unbalance"] = np.int64(0)
    for name in ["rotation_rate", "frequency"]:
        response[name] = numbers(1)
    response["lifts_off"] = np.arange(1)
    for name, rows in RESPONSE.items():
        response[name] = numbers(1, rows)


for make in [run, run_without_records, run_compressed, buckling, torque_drag, modes]:
    with h5py.File(pathlib.Path(sys.argv[1]) / make.__name__, "w") as made:
        make(made)
