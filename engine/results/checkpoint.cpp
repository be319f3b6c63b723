#include "drillstrand/checkpoint.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <sstream>

#include "drillstrand/case.hpp"
#include "drillstrand/new_file.hpp"
#include "drillstrand/result_layout.hpp"
#include "drillstrand/version.hpp"
#include "results/hdf5.hpp"
#include "results/held_file.hpp"
#include "results/reading.hpp"

namespace drillstrand {

namespace {

namespace fs = std::filesystem;

// groups of rows
constexpr const char* state_group = "/checkpoint/state";
constexpr const char* summary_group = "/checkpoint/summary";
constexpr const char* scene_group = "/checkpoint/scene";

/// The string and the well of a header as rows of numbers: what a case file does not say itself,
/// since it names other files.
SavedState scene_rows(const ResultHeader& header) {
    SavedState rows;
    const auto add = [&](const std::string& path, const std::string& units,
                         std::vector<double> values) {
        std::string name = path.substr(1);
        rows.push_back({std::move(name), units, std::move(values)});
    };
    for (const auto* table : {&mesh_datasets(), &string_datasets()}) {
        for (const auto& entry : *table) {
            std::vector<double> values;
            entry.append(header, values);
            add(entry.path, entry.units, std::move(values));
        }
    }
    if (header.well) {
        for (const WellDataset& entry : well_datasets())
            add(entry.path, entry.units, entry.values(*header.well));
    }
    return rows;
}

// ------------------------------------------------------------------ writing

void write_rows(H5::H5File& file, const std::string& group_path, const SavedState& rows) {
    H5::Group group = file.createGroup(group_path);
    std::string names;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const std::string number = fmt::format("{}/{}", group_path, i);
        hdf5::write_values(file, number, false, {rows[i].values.size()}, rows[i].unit, rows[i].name,
                           rows[i].values);
        names += rows[i].name + '\n';
    }
    hdf5::write_attribute(group, "rows", names);
}

void write_file(const fs::path& path, const Checkpoint& checkpoint) {
    H5::H5File file(path, H5F_ACC_TRUNC, H5::FileCreatPropList::DEFAULT, hdf5::file_access());
    H5::Group root = file.openGroup("/");
    hdf5::write_origin(root, checkpoint.header);
    hdf5::write_attribute(root, "integrator", checkpoint.header.integrator);
    hdf5::write_attribute(root, "isa", checkpoint.header.isa);
    hdf5::write_attribute(root, "status", std::string("checkpoint"));
    H5::Group group = file.createGroup("/checkpoint");
    hdf5::write_attribute(group, "time", checkpoint.time);
    hdf5::write_attribute(group, "wall_seconds", checkpoint.wall_seconds);
    hdf5::write_attribute(group, "series", static_cast<std::int64_t>(checkpoint.series));
    hdf5::write_attribute(group, "profiles", static_cast<std::int64_t>(checkpoint.profiles));
    write_rows(file, state_group, checkpoint.state);
    write_rows(file, summary_group, checkpoint.summary);
    write_rows(file, scene_group, scene_rows(checkpoint.header));
    group.close();
    root.close();
    file.close();
}

std::size_t bytes_of(const SavedState& rows) {
    std::size_t bytes = 0;
    for (const SavedRow& row : rows)
        bytes += row.values.size() * sizeof(double) + 1024;  // and its header
    return bytes;
}

/// A second name for the checkpoint that is there, so that none is missing at any moment.
void keep_previous(const fs::path& path) {
    const fs::path previous = previous_checkpoint_path(path);
    const fs::path fresh = previous.string() + ".new";
    ::unlink(fresh.c_str());
    if (::link(path.c_str(), fresh.c_str()) != 0) return;  // there is none, or no links are here
    if (::rename(fresh.c_str(), previous.c_str()) != 0) ::unlink(fresh.c_str());
}

// ------------------------------------------------------------------ reading

SavedState read_rows(hdf5::UntrustedFile& file, const std::string& group_path) {
    hdf5::refuse_foreign_links(file, group_path);
    std::string names;
    hdf5::read_attribute(file.hdf5().openGroup(group_path), "rows", names);
    SavedState rows;
    std::istringstream lines(names);
    for (std::string name; std::getline(lines, name);) {
        const std::string path = fmt::format("{}/{}", group_path, rows.size());
        rows.push_back(
            {name, "", hdf5::read_checked_values(file, path, false, {hdf5::any_extent})});
    }
    return rows;
}

std::size_t read_count(const H5::Group& group, const char* name) {
    std::int64_t count = 0;
    hdf5::read_attribute(group, name, count);
    if (count < 0) throw hdf5::UnsoundFile(fmt::format("attribute {} is negative", name));
    return static_cast<std::size_t>(count);
}

}  // namespace

fs::path checkpoint_path(const fs::path& result) {
    fs::path path = result;
    return path.replace_extension(".checkpoint.h5");
}

fs::path previous_checkpoint_path(const fs::path& checkpoint) {
    fs::path path = checkpoint;
    path.replace_extension();  // .h5
    return path.string() + ".previous.h5";
}

void write_checkpoint(const fs::path& path, const Checkpoint& checkpoint) {
    NewFile fresh(path, Existing::replace);
    fresh.held().require_space(bytes_of(checkpoint.state) + bytes_of(checkpoint.summary) +
                               bytes_of(scene_rows(checkpoint.header)) +
                               checkpoint.header.case_text.size() + metadata_bytes);
    hdf5::attempt<WriteError>(path, "write", [&] { write_file(fresh.path(), checkpoint); });
    fresh.held().sync();
    keep_previous(followed(path));
    fresh.take_name();
}

bool holds_checkpoint(const fs::path& path) {
    return hdf5::holds_group(path, "/checkpoint");
}

Checkpoint read_checkpoint(const fs::path& path) {
    return hdf5::read_file(path, [&](hdf5::UntrustedFile& file) {
        if (!hdf5::holds(file, "/checkpoint"))
            throw hdf5::UnsoundFile(
                "this is not a checkpoint; drillstrand run writes them beside "
                "its result, as NAME.checkpoint.h5");
        Checkpoint checkpoint;
        const H5::Group root = file.hdf5().openGroup("/");
        hdf5::read_origin(root, checkpoint.header, checkpoint.version, checkpoint.commit);
        hdf5::read_attribute(root, "integrator", checkpoint.header.integrator);
        hdf5::read_attribute(root, "isa", checkpoint.header.isa);
        const H5::Group group = file.hdf5().openGroup("/checkpoint");
        hdf5::read_attribute(group, "time", checkpoint.time);
        hdf5::read_attribute(group, "wall_seconds", checkpoint.wall_seconds);
        checkpoint.series = read_count(group, "series");
        checkpoint.profiles = read_count(group, "profiles");
        checkpoint.state = read_rows(file, state_group);
        checkpoint.summary = read_rows(file, summary_group);
        checkpoint.scene = read_rows(file, scene_group);
        return checkpoint;
    });
}

void require_same_run(const fs::path& path, const Checkpoint& checkpoint,
                      const ResultHeader& header, bool same_bits_everywhere) {
    const auto refuse = [&](const std::string& what, const std::string& was,
                            const std::string& is) {
        throw ResultError(fmt::format("{}: the checkpoint is of another {}: {}, not {}",
                                      path.string(), what, was, is));
    };
    if (checkpoint.version != version()) refuse("version", checkpoint.version, version());
    if (checkpoint.commit != commit())
        refuse("build of this version", "commit " + checkpoint.commit, commit());
    if (checkpoint.header.integrator != header.integrator)
        refuse("integrator", checkpoint.header.integrator, header.integrator);
    if (const auto key = first_difference(checkpoint.header.case_text, header.case_text))
        throw ResultError(
            fmt::format("{}: the checkpoint is of another case: {} differs", path.string(), *key));
    const SavedState scene = scene_rows(header);
    for (std::size_t i = 0; i < std::max(scene.size(), checkpoint.scene.size()); ++i) {
        const bool both = i < scene.size() && i < checkpoint.scene.size();
        if (both && scene[i].name == checkpoint.scene[i].name &&
            scene[i].values == checkpoint.scene[i].values)
            continue;
        throw ResultError(fmt::format(
            "{}: the checkpoint is of another case: {} differs, from a file that the case names",
            path.string(), i < scene.size() ? scene[i].name : checkpoint.scene[i].name));
    }
    if (!same_bits_everywhere && checkpoint.header.isa != header.isa)
        throw ResultError(
            fmt::format("{}: the checkpoint is of another instruction set: {}, not "
                        "{}; run with --isa {}",
                        path.string(), checkpoint.header.isa, header.isa, checkpoint.header.isa));
}

}  // namespace drillstrand
