#!/usr/bin/python3
"""Opens a result file of 7 segments, 4 series times and 2 profiles as another program would."""

import sys

import h5py

SHAPES = {
    "/mesh/node_s": (8,),
    "/mesh/segment_s": (7,),
    "/string/component_name": (0,),
    "/string/component_start": (0,),
    "/string/component_end": (0,),
    "/string/cell": (8,),
    "/string/mass": (8,),
    "/string/weight": (8,),
    "/string/outer_radius": (8,),
    "/string/polar_inertia": (8,),
    "/string/metal_area": (7,),
    "/string/yield_tension": (7,),
    "/string/yield_bending": (7,),
    "/string/yield_torque": (7,),
    "/well/measured_depth": (3,),
    "/well/inclination": (3,),
    "/well/azimuth": (3,),
    "/well/position": (3, 3),
    "/well/section_end": (2,),
    "/well/section_diameter": (2,),
    "/well/section_name": (2,),
    "/well/section_end_diameter": (2,),
    "/well/section_static_friction": (2, 2),
    "/well/section_dynamic_friction": (2, 2),
    "/well/section_normal_stiffness": (2,),
    "/series/time": (4,),
    "/series/head_stress": (4, 6),
    "/series/bit_stress": (4, 6),
    "/series/head_position": (4, 3),
    "/series/bit_position": (4, 3),
    "/series/head_rotation_rate": (4,),
    "/series/bit_rotation_rate": (4,),
    "/series/hook_load": (4,),
    "/series/dead_line_tension": (4,),
    "/series/surface_torque": (4,),
    "/series/drive_torque": (4,),
    "/series/weight_on_bit": (4,),
    "/series/bit_torque": (4,),
    "/series/depth_of_cut": (4,),
    "/series/drilled": (4,),
    "/series/jar_force": (4,),
    "/series/jar_travel": (4,),
    "/series/jar_blows": (4,),
    "/series/kinetic_energy": (4,),
    "/series/rotation_energy": (4,),
    "/series/half_step_energy": (4,),
    "/series/elastic_energy": (4,),
    "/series/spring_energy": (4,),
    "/series/potential_energy": (4,),
    "/series/work": (4,),
    "/series/dissipation": (4,),
    "/series/step_size": (4,),
    "/series/time_error": (4,),
    "/series/max_penetration": (4,),
    "/series/relative_penetration": (4,),
    "/series/penetration_depth": (4,),
    "/series/helix_penetration": (4,),
    "/series/wall_drag": (4,),
    "/series/drag_depth": (4,),
    "/series/whirl_forward": (4,),
    "/series/whirl_backward": (4,),
    "/series/whirl_rate": (4,),
    "/series/rolling_rate": (4,),
    "/series/whirl_depth": (4,),
    "/series/contact_nodes": (4,),
    "/series/impacts": (4,),
    "/series/contact_changes": (4,),
    "/series/slips": (4,),
    "/profiles/time": (2,),
    "/profiles/position": (2, 8, 3),
    "/profiles/director": (2, 8, 3),
    "/profiles/momentum": (2, 8, 6),
    "/profiles/stress": (2, 7, 6),
    "/profiles/moment": (2, 8, 3),
    "/profiles/eccentricity": (2, 8),
    "/profiles/well_depth": (2, 8),
    "/profiles/contact_force": (2, 8, 3),
    "/profiles/normal_force": (2, 8),
    "/profiles/side_force": (2, 8),
    "/profiles/whirl_rate": (2, 8),
}
TEXTS = ["title", "case", "version", "commit", "integrator", "status"]
NUMBERS = ["threads", "wall_seconds", "steps", "steps_rejected", "energy_residual"]

with h5py.File(sys.argv[1], "r") as file:
    for name in TEXTS:
        assert isinstance(file.attrs[name], str) and file.attrs[name], name
    for name in NUMBERS:
        assert file.attrs[name].shape == (), name
    assert file.attrs["status"] == "running"
    for path, shape in SHAPES.items():
        dataset = file[path]
        assert dataset.shape == shape, (path, dataset.shape)
        assert isinstance(dataset.attrs["units"], str) and dataset.attrs["units"], path
        assert isinstance(dataset.attrs["description"], str) and dataset.attrs["description"], path
        dataset[...]
    found = []
    file.visititems(lambda name, item: found.append("/" + name) if hasattr(item, "shape") else None)
    assert set(found) == set(SHAPES), set(found) ^ set(SHAPES)
    for path in found:
        if path.startswith("/profiles") and path != "/profiles/time":
            assert file[path].shuffle and file[path].compression_opts == 4, path
    for name in ["contact_nodes", "impacts", "contact_changes", "slips"]:
        assert file["/series/" + name].dtype.kind == "i", name
