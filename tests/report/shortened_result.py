#!/usr/bin/python3
"""A copy of a result file with only its first records: shortened_result.py OUT.h5 COPY.h5 RECORDS PROFILES"""

import shutil
import sys

import h5py

source, copy, records, profiles = sys.argv[1:]
shutil.copyfile(source, copy)
with h5py.File(copy, "r+") as file:
    for group, count in [("series", int(records)), ("profiles", int(profiles))]:
        for dataset in file[group].values():
            dataset.resize(count, axis=0)
    for sensor in file["sensors"].values():
        for dataset in sensor.values():
            dataset.resize(int(records), axis=0)
    file.attrs["status"] = "running"
