"""Files that no drillstrand wrote: sound ones with one thing wrong, by name; always the same ones."""

import os
import socket
import struct
import zlib

import h5py
import numpy as np

SERIES, PROFILE = "series/head_stress", "profiles/position"


# What damages a copy of a run's file, by name.
KINDS = {}


def edit(name, change):
    """A kind that changes the open file."""
    def damage(path):
        with h5py.File(path, "r+") as file:
            change(file)
    KINDS[name] = damage


def replace(file, name, **dataset):
    """Puts another dataset in a place, with the attributes of the old one."""
    attributes = dict(file[name].attrs)
    del file[name]
    new = file.create_dataset(name, **dataset)
    new.attrs.update(attributes)
    return new


def set_attribute(file, name, value, **more):
    del file.attrs[name]
    file.attrs.create(name, value, **more)


def attribute_kinds():
    for name in ["title", "case", "version", "commit", "status", "integrator"]:
        edit(f"{name}_missing", lambda file, name=name: file.attrs.__delitem__(name))
        edit(f"{name}_a_number", lambda file, name=name: set_attribute(file, name, 5.0))
        edit(f"{name}_a_list", lambda file, name=name: set_attribute(
            file, name, ["a", "b", "c"], dtype=h5py.string_dtype()))
        edit(f"{name}_empty_space", lambda file, name=name: set_attribute(
            file, name, h5py.Empty(h5py.string_dtype())))
    edit("title_fixed_length", lambda file: set_attribute(file, "title", np.bytes_("x" * 60000)))
    edit("title_without_text", lambda file: set_attribute(file, "title", ""))
    edit("title_bytes_of_no_text", lambda file: set_attribute(
        file, "title", b"\xff\xfe\xc0\xaf\xed\xa0\x80", dtype=h5py.string_dtype("utf-8")))
    edit("title_of_terminal_codes", lambda file: set_attribute(
        file, "title", "\x1b]0;owned\x07\x1b[2J\r\nstatus: complete\x9b31m\u202e</title><script>"))
    edit("status_of_terminal_codes", lambda file: set_attribute(file, "status", "\x1b[31m\n\x07"))
    edit("version_of_terminal_codes", lambda file: set_attribute(file, "version", "\x1b[31m\n\x07"))
    edit("integrator_of_terminal_codes", lambda file: set_attribute(
        file, "integrator", "\x1b[31m\n\x07"))
    edit("case_of_10_megabytes", lambda file: set_attribute(
        file, "case", "x" * 10_000_000, dtype=h5py.string_dtype()))
    edit("title_a_reference", lambda file: set_attribute(
        file, "title", file["series"].ref, dtype=h5py.ref_dtype))
    for name in ["steps", "wall_seconds", "time_error", "energy_residual", "threads"]:
        edit(f"{name}_missing", lambda file, name=name: file.attrs.__delitem__(name))
        edit(f"{name}_a_list", lambda file, name=name: set_attribute(
            file, name, np.arange(5000, dtype=file.attrs[name].dtype)))
        edit(f"{name}_of_no_entries", lambda file, name=name: set_attribute(
            file, name, np.zeros(0, dtype=file.attrs[name].dtype)))
        edit(f"{name}_text", lambda file, name=name: set_attribute(file, name, "many"))
    edit("steps_a_compound", lambda file: set_attribute(
        file, "steps", np.zeros((), dtype=[("a", "<i8"), ("b", "<f8", 100)])))
    edit("threads_beyond_integers", lambda file: set_attribute(file, "threads", 2**62))
    edit("numbers_that_are_none", lambda file: [set_attribute(file, name, value) for name, value in [
        ("wall_seconds", np.inf), ("time_error", np.nan), ("energy_residual", -np.inf),
        ("smallest_step", np.nan), ("largest_step", 1e308)]])


def dataset_kinds():
    for name in ["mesh/node_s", "string/mass", "well/inclination", "well/section_end", "series/time",
                 SERIES, "profiles/time", PROFILE]:
        word = name.replace("/", "_")
        edit(f"{word}_missing", lambda file, name=name: file.__delitem__(name))
        edit(f"{word}_a_group", lambda file, name=name: (file.__delitem__(name),
                                                         file.create_group(name)))
        edit(f"{word}_empty", lambda file, name=name: replace(
            file, name, shape=(0,) + file[name].shape[1:], dtype="f8"))
        edit(f"{word}_one_value", lambda file, name=name: replace(file, name, data=1.0))
        edit(f"{word}_no_space", lambda file, name=name: replace(
            file, name, data=h5py.Empty("f8")))
        edit(f"{word}_one_row_short", lambda file, name=name: replace(
            file, name, data=file[name][:-1]))
        edit(f"{word}_a_row_more", lambda file, name=name: replace(
            file, name, data=np.concatenate([file[name][...], file[name][-1:]])))
        edit(f"{word}_another_rank", lambda file, name=name: replace(
            file, name, data=file[name][...][..., None]))
        edit(f"{word}_integers", lambda file, name=name: replace(
            file, name, data=np.zeros(file[name].shape, "i8")))
        edit(f"{word}_single_precision", lambda file, name=name: replace(
            file, name, data=file[name][...].astype("f4")))
        edit(f"{word}_text", lambda file, name=name: replace(
            file, name, data=np.full(file[name].shape, b"text", "S4")))
        edit(f"{word}_variable_length", lambda file, name=name: replace(
            file, name, shape=file[name].shape, dtype=h5py.vlen_dtype("f8")))
        edit(f"{word}_references", lambda file, name=name: replace(
            file, name, shape=file[name].shape, dtype=h5py.ref_dtype))
        edit(f"{word}_compound", lambda file, name=name: replace(
            file, name, shape=file[name].shape, dtype=[("a", "f8"), ("b", "f8", 9)]))
        edit(f"{word}_of_huge_extent", lambda file, name=name: replace(
            file, name, shape=(2**40,) + file[name].shape[1:], dtype="f8",
            chunks=(1,) + file[name].shape[1:]))
        edit(f"{word}_of_huge_extent_compressed", lambda file, name=name: replace(
            file, name, shape=(2**40,) + file[name].shape[1:], dtype="f8", compression=4,
            chunks=(1,) + file[name].shape[1:]))
        edit(f"{word}_of_no_number", lambda file, name=name: file[name].write_direct(
            np.full(file[name].shape, np.nan)))
        edit(f"{word}_infinite", lambda file, name=name: file[name].write_direct(
            np.full(file[name].shape, np.inf)))
        edit(f"{word}_of_1e308", lambda file, name=name: file[name].write_direct(
            np.linspace(-8e307, 8e307, file[name].size).reshape(file[name].shape)))
        edit(f"{word}_tiny", lambda file, name=name: file[name].write_direct(
            5e-324 * np.arange(1, 1 + file[name].size).reshape(file[name].shape)))
    for name in ["mesh", "series", "profiles", "string", "well"]:
        edit(f"group_{name}_missing", lambda file, name=name: file.__delitem__(name))
        edit(f"group_{name}_a_dataset", lambda file, name=name: (
            file.__delitem__(name), file.create_dataset(name, data=np.arange(4.0))))
        edit(f"group_{name}_empty", lambda file, name=name: (
            file.__delitem__(name), file.create_group(name)))
    edit("counts_beyond_integers", lambda file: file["series/contact_nodes"].write_direct(
        np.full(file["series/contact_nodes"].shape, np.iinfo("i8").max)))
    edit("counts_unsigned", lambda file: replace(
        file, "series/contact_nodes", data=np.full(file["series/time"].shape, 2**64 - 1, "u8")))
    edit("counts_of_doubles", lambda file: replace(
        file, "series/contact_nodes", data=np.full(file["series/time"].shape, 1e300)))
    edit("time_descends", lambda file: file["series/time"].write_direct(
        file["series/time"][...][::-1].copy()))
    edit("time_stands_still", lambda file: file["profiles/time"].write_direct(
        np.zeros(file["profiles/time"].shape)))
    edit("no_record", lambda file: [data.resize(0, axis=0) for data in file["series"].values()])
    edit("no_profile", lambda file: [data.resize(0, axis=0) for data in file["profiles"].values()])
    edit("no_record_and_no_profile", lambda file: [
        data.resize(0, axis=0) for name in ["series", "profiles"] for data in file[name].values()])
    edit("one_record", lambda file: [data.resize(1, axis=0) for data in file["series"].values()])
    edit("extents_that_nothing_was_written_to", lambda file: [
        data.resize(10**9, axis=0) for data in file["series"].values()])
    edit("profiles_that_nothing_was_written_to", lambda file: [
        data.resize(10**6, axis=0) for data in file["profiles"].values()])
    edit("well_of_one_station", lambda file: [replace(file, "well/" + name, data=file["well"][name][:1])
                                              for name in ["measured_depth", "inclination", "azimuth",
                                                           "position"]])
    edit("well_that_turns_back", lambda file: file["well/inclination"].write_direct(
        np.pi * (np.arange(file["well/inclination"].size) % 2)))
    edit("hole_wider_than_its_bends", lambda file: file["well/section_diameter"].write_direct(
        np.full(file["well/section_diameter"].shape, 1e6)))
    edit("hole_of_no_width", lambda file: file["well/section_diameter"].write_direct(
        np.zeros(file["well/section_diameter"].shape)))
    edit("depths_of_no_well", lambda file: file["profiles/well_depth"].write_direct(
        np.full(file["profiles/well_depth"].shape, np.inf)))
    edit("mesh_of_one_node", lambda file: (replace(file, "mesh/node_s", data=[0.0]),
                                           replace(file, "mesh/segment_s", shape=(0,), dtype="f8")))
    edit("mesh_of_no_node", lambda file: (replace(file, "mesh/node_s", shape=(0,), dtype="f8"),
                                          replace(file, "mesh/segment_s", shape=(0,), dtype="f8")))


def link_kinds():
    def link(file, name, target):
        del file[name]
        file[name] = target

    def move(file, name):
        file.move(name, "moved")
        file[name] = h5py.SoftLink("/moved")
    for name in ["series/time", "series", "mesh/node_s", "well"]:
        word = name.replace("/", "_")
        edit(f"{word}_in_another_file", lambda file, name=name: link(
            file, name, h5py.ExternalLink("sound.h5", "/" + name)))
        edit(f"{word}_in_a_pipe", lambda file, name=name: link(
            file, name, h5py.ExternalLink("pipe", "/" + name)))
        edit(f"{word}_in_a_file_that_is_not_there", lambda file, name=name: link(
            file, name, h5py.ExternalLink("nowhere.h5", "/" + name)))
        edit(f"{word}_by_name", lambda file, name=name: move(file, name))
        edit(f"{word}_by_its_own_name", lambda file, name=name: link(
            file, name, h5py.SoftLink("/" + name)))
        edit(f"{word}_by_a_name_that_is_not_there", lambda file, name=name: link(
            file, name, h5py.SoftLink("/nowhere")))

    edit("group_in_itself", lambda file: (file.__delitem__("series"),
                                          file.__setitem__("series", file["/"])))
    edit("link_to_a_pipe_that_nobody_asks_for", lambda file: file.__setitem__(
        "more", h5py.ExternalLink("pipe", "/")))

    def external(file, name, source):
        shape = file[name].shape
        del file[name]
        properties = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
        properties.set_external(os.fsencode(source), 0, int(np.prod(shape)) * 8)
        h5py.h5d.create(file.id, name.encode(), h5py.h5t.IEEE_F64LE, h5py.h5s.create_simple(shape),
                        properties)
    for name in ["mesh/node_s", "well/inclination", "series/time"]:
        word = name.replace("/", "_")
        edit(f"{word}_stored_in_a_system_file", lambda file, name=name: external(
            file, name, "/etc/passwd"))
        edit(f"{word}_stored_in_a_pipe", lambda file, name=name: external(file, name, "pipe"))
        edit(f"{word}_stored_nowhere", lambda file, name=name: external(file, name, "nowhere"))

    def virtual(file, name, source):
        shape = file[name].shape
        del file[name]
        layout = h5py.VirtualLayout(shape=shape, dtype="f8")
        layout[...] = h5py.VirtualSource(source, name, shape=shape)
        file.create_virtual_dataset(name, layout)
    for name in ["mesh/node_s", "series/time"]:
        for target, source in [("another_file", "sound.h5"), ("a_pipe", "pipe")]:
            edit(f"{name.replace('/', '_')}_made_of_{target}",
                 lambda file, name=name, source=source: virtual(file, name, source))


def storage_kinds():
    edit("another_filter", lambda file: replace(file, "series/time", data=file["series/time"][...],
                                                compression="lzf"))
    edit("checksums", lambda file: replace(file, "series/time", data=file["series/time"][...],
                                           fletcher32=True))
    edit("scale_and_offset", lambda file: replace(file, "series/time", data=file["series/time"][...],
                                                  scaleoffset=2))

    def filtered(file, name, chunk, *filters):
        data = file[name][...]
        del file[name]
        properties = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
        properties.set_chunk(chunk)
        for code, values in filters:
            properties.set_filter(code, h5py.h5z.FLAG_OPTIONAL, values)
        made = h5py.h5d.create(file.id, name.encode(), h5py.h5t.IEEE_F64LE,
                               h5py.h5s.create_simple(data.shape), properties)
        return made, data
    edit("a_filter_that_nobody_has", lambda file: filtered(
        file, "series/time", (2,), (31999, (1, 2, 3))))
    edit("deflated_twice", lambda file: (lambda made: made[0].write(
        h5py.h5s.ALL, h5py.h5s.ALL, made[1]))(filtered(
            file, "series/time", (2,), (h5py.h5z.FILTER_DEFLATE, (9,)),
            (h5py.h5z.FILTER_DEFLATE, (9,)))))

    def bomb(file, size):
        """A chunk of half a megabyte that inflates to `size` bytes."""
        deflate = zlib.compressobj(9)
        block = [deflate.compress(bytes(1 << 20)) + deflate.flush(zlib.Z_FULL_FLUSH) for _ in range(2)]
        shape = file[PROFILE].shape[1:]
        data = replace(file, PROFILE, shape=file[PROFILE].shape, dtype="f8", compression=9,
                       chunks=(2000,) + shape, maxshape=(None,) + shape)
        data.id.write_direct_chunk((0, 0, 0), block[0] + block[1] * (size >> 20))
    edit("chunk_that_inflates_to_a_gigabyte", lambda file: bomb(file, 1 << 30))
    edit("chunk_that_inflates_to_four_gigabytes", lambda file: bomb(file, 4 << 30))
    for name, stream in [("chunk_cut_off", zlib.compress(bytes(240))[:9]),
                         ("chunk_of_noise", np.random.default_rng(1).bytes(5000)),
                         ("chunk_too_short", zlib.compress(bytes(8)))]:
        edit(name, lambda file, stream=stream: file[PROFILE].id.write_direct_chunk((0, 0, 0), stream))
    edit("huge_chunks", lambda file: replace(file, SERIES, shape=file[SERIES].shape, dtype="f8",
                                             chunks=(10**7, 6), maxshape=(None, 6)))
    edit("huge_chunks_compressed", lambda file: replace(
        file, SERIES, data=file[SERIES][...], chunks=(8 * 10**6, 6), maxshape=(None, 6),
        compression=9))

    def zeros(file):
        """Consistent, and a hundred times larger in memory than on the disk."""
        count = 20000
        for name in ["series", "profiles"]:
            for entry in list(file[name]):
                old = file[name][entry]
                shape = (count,) + old.shape[1:]
                data = replace(file, f"{name}/{entry}", shape=shape, dtype=old.dtype, compression=9,
                               chunks=(min(count, max(1, 800000 // max(1, int(np.prod(shape[1:]))))),)
                               + shape[1:])
                if entry == "time":
                    data[...] = np.arange(count)
                else:
                    for start in range(0, count, data.chunks[0]):
                        data[start:start + data.chunks[0]] = 0
    edit("zeros_that_fill_the_memory", zeros)


def rewrite(name, change):
    """A kind that changes the bytes of a file."""
    def damage(path):
        data = bytearray(path.read_bytes())
        path.write_bytes(change(data))
    KINDS[name] = damage


def byte_kinds():
    def patched(data, place, value):
        data[place:place + len(value)] = value
        return data
    word = lambda value: struct.pack("<Q", value)
    rewrite("nothing_at_all", lambda data: b"")
    rewrite("text", lambda data: b'title = "no result"\n')
    rewrite("signature_alone", lambda data: data[:8])
    rewrite("zeros_behind_the_signature", lambda data: data[:8] + bytes(4096))
    rewrite("ones_behind_the_signature", lambda data: data[:8] + b"\xff" * 4096)
    rewrite("a_block_of_the_user_before_it", lambda data: bytes(512) + data)
    for version in [1, 2, 3, 77]:
        rewrite(f"superblock_version_{version}", lambda data, version=version: patched(
            data, 8, bytes([version])))
    rewrite("addresses_of_3_bytes", lambda data: patched(data, 13, b"\x03"))
    rewrite("lengths_of_255_bytes", lambda data: patched(data, 14, b"\xff"))
    rewrite("base_beyond_the_end", lambda data: patched(data, 24, word(1 << 60)))
    rewrite("end_beyond_the_end", lambda data: patched(data, 40, word(1 << 60)))
    rewrite("a_driver_of_its_own", lambda data: patched(data, 48, word(96)))
    rewrite("root_beyond_the_end", lambda data: patched(data, 64, word(1 << 40)))
    rewrite("root_at_the_signature", lambda data: patched(data, 64, word(0)))
    rewrite("huge_nodes_of_groups", lambda data: patched(data, 16, b"\xff\xff\xff\xff"))
    rewrite("no_nodes_of_groups", lambda data: patched(data, 16, b"\0\0\0\0"))

    def everywhere(data, mark, offset, value):
        place = data.find(mark)
        while place >= 0:
            patched(data, place + offset, value)
            place = data.find(mark, place + len(mark))
        return data

    def trees_that_point_at_themselves(data):
        place = data.find(b"TREE")
        while place >= 0:
            patched(data, place + 16, word(place))
            place = data.find(b"TREE", place + 4)
        return data
    rewrite("trees_that_point_at_themselves", trees_that_point_at_themselves)
    rewrite("trees_of_level_255", lambda data: everywhere(data, b"TREE", 5, b"\xff"))
    rewrite("trees_of_65535_entries", lambda data: everywhere(data, b"TREE", 6, b"\xff\xff"))
    rewrite("trees_of_no_entries", lambda data: everywhere(data, b"TREE", 6, b"\0\0"))
    rewrite("tables_of_65535_names", lambda data: everywhere(data, b"SNOD", 6, b"\xff\xff"))
    rewrite("heaps_of_all_memory", lambda data: everywhere(data, b"HEAP", 8, word(1 << 62)))
    rewrite("heaps_of_4_gigabytes", lambda data: everywhere(data, b"HEAP", 8, word(1 << 32)))
    rewrite("heaps_with_a_wrong_list", lambda data: everywhere(data, b"HEAP", 16, word(3)))
    rewrite("texts_of_all_memory", lambda data: everywhere(data, b"GCOL", 8, word(1 << 62)))
    rewrite("texts_of_4_gigabytes", lambda data: everywhere(data, b"GCOL", 24, word(1 << 32)))
    rewrite("texts_longer_than_their_heap", lambda data: everywhere(data, b"GCOL", 24, word(4000)))
    rewrite("texts_of_no_length", lambda data: everywhere(data, b"GCOL", 24, word(0)))


def special_files(folder):
    """Names that are no regular files, or lead to none."""
    os.mkfifo(folder / "pipe")
    with socket.socket(socket.AF_UNIX) as made:
        made.bind(str(folder / "socket"))
    (folder / "folder").mkdir()
    for link, target in [("link_to_pipe", "pipe"), ("link_to_socket", "socket"), ("loop", "loop"),
                         ("link_to_folder", "folder"), ("link_to_nothing", "nothing"),
                         ("link_to_device", "/dev/zero")]:
        (folder / link).symlink_to(target)
    return ["pipe", "socket", "folder", "link_to_pipe", "link_to_socket", "loop", "link_to_folder",
            "link_to_nothing", "link_to_device", "/dev/null", "/dev/tty", "no/such/folder", ""]


def cut_off(data, count):
    """`count` beginnings of a file, of all lengths."""
    size = len(data)
    lengths = {int(size * share) for share in np.linspace(0, 1, count, endpoint=False)}
    return {f"cut_to_{length}_bytes": data[:length] for length in sorted(lengths)}


def flipped(data, count, seed):
    """`count` copies with some bytes changed, most of them in what describes the values."""
    random = np.random.default_rng(seed)
    marks = [0]
    for mark in [b"TREE", b"SNOD", b"HEAP", b"GCOL", b"units", b"OHDR"]:
        place = data.find(mark)
        while place >= 0:
            marks.append(place)
            place = data.find(mark, place + 1)
    copies = {}
    for k in range(count):
        copy = bytearray(data)
        for _ in range(1 + k % 8):
            place = int(random.integers(len(data)))
            if random.random() < 0.8:
                place = int(random.choice(marks)) + int(random.integers(-300, 300))
            if not 0 <= place < len(data):
                continue
            copy[place] = int(random.choice([0, 1, 0x7f, 0x80, 0xff, random.integers(256)]))
        copies[f"flipped_{seed}_{k}"] = bytes(copy)
    return copies


attribute_kinds()
dataset_kinds()
link_kinds()
storage_kinds()
byte_kinds()
