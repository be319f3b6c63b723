"""Compares two result files dataset by dataset: equal_datasets.py A.h5 B.h5. Exit code 1, and what
differs, where they are not the same."""
import sys

import h5py
import numpy


def datasets(file):
    found = {}
    file.visititems(lambda name, item: found.update({name: item[()]})
                    if isinstance(item, h5py.Dataset) else None)
    return found


def content(values):
    """Texts are held by reference."""
    return values.tolist() if values.dtype == object else values.tobytes()


with h5py.File(sys.argv[1]) as left, h5py.File(sys.argv[2]) as right:
    lefts, rights = datasets(left), datasets(right)
    different = sorted(lefts.keys() ^ rights.keys())
    different += [name for name in sorted(lefts.keys() & rights.keys())
                  if lefts[name].shape != rights[name].shape
                  or content(lefts[name]) != content(rights[name])]
    different += [name for name in ("title", "case", "integrator", "status")
                  if left.attrs[name] != right.attrs[name]]
    if not any(numpy.size(values) for values in lefts.values()):
        different.append("no dataset holds anything")
if different:
    sys.exit("\n".join(different))
