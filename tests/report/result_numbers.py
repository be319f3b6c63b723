#!/usr/bin/python3
"""Numbers of a result file as JSON, read by h5py: result_numbers.py OUT.h5"""

import json
import sys

import h5py
import numpy as np

with h5py.File(sys.argv[1]) as file:
    group = {name: file[name][...] for name in ["series/time", "profiles/time", "mesh/node_s", "mesh/segment_s"]}
    series, profiles = file["series"], file["profiles"]
    numbers = {name: values.tolist() for name, values in group.items()}
    for name in ["head_stress", "bit_stress", "head_rotation_rate", "bit_rotation_rate", "hook_load", "surface_torque",
                 "drive_torque", "weight_on_bit", "bit_torque", "step_size",
                 "max_penetration", "helix_penetration", "contact_nodes", "whirl_backward", "whirl_forward", "whirl_rate",
                 "rolling_rate", "wall_drag", "kinetic_energy", "rotation_energy", "work"]:
        numbers["series/" + name] = series[name][...].tolist()
    for sensor in file.get("sensors", {}):
        for name, values in file["sensors"][sensor].items():
            numbers[f"sensors/{sensor}/{name}"] = values[...].tolist()
    numbers["profile_count"] = profiles["time"].shape[0]
    if profiles["time"].shape[0]:
        wanted = sorted({0, profiles["time"].shape[0] - 1} | {int(k) for k in sys.argv[2:]})
        numbers["profiles"] = {
            str(k): {
                "axial": profiles["stress"][k, :, 3].tolist(),
                "torque": (-profiles["stress"][k, :, 0]).tolist(),
                "bending": np.hypot(profiles["stress"][k, :, 1], profiles["stress"][k, :, 2]).tolist(),
                "side": profiles["side_force"][k].tolist(),
                "eccentricity": profiles["eccentricity"][k].tolist(),
                "whirl": profiles["whirl_rate"][k].tolist(),
                "spin": (profiles["momentum"][k, :, 0] / file["string/polar_inertia"][...]).tolist(),
            }
            for k in wanted
        }
    numbers["findings"] = list(file.attrs["findings"])
    numbers["attributes"] = {name: file.attrs[name] for name in ["status", "energy_residual", "title", "stick_slip_index"]}

json.dump(numbers, sys.stdout)
