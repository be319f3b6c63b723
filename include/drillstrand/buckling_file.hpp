/// Files of buckling modes (HDF5). The layout is listed in engine/results/README.md.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "drillstrand/buckling.hpp"
#include "drillstrand/new_file.hpp"
#include "drillstrand/result_file.hpp"

namespace drillstrand {

/// The modes of a string, and what they were computed of. Nothing runs in time: integrator and
/// threads of the header are not stored.
struct BucklingResult {
    ResultHeader header;
    Discretisation discretisation = Discretisation::beam_column;
    std::vector<BucklingMode> modes;
    std::optional<Instability> instability;  ///< where one was asked for
    std::string version;  ///< of the drillstrand that wrote the file; set by reading
    std::string commit;
};

/// Writes a file, which takes its name once it is sound. Throws ResultError where it cannot be
/// written.
void write_buckling(const std::filesystem::path& path, const BucklingResult& result,
                    Existing existing = Existing::replace);

/// Whether a file is one of buckling modes. Throws ResultError where it is no result file.
bool holds_buckling(const std::filesystem::path& path);

/// Throws ResultError where the file is not one of buckling modes.
BucklingResult read_buckling(const std::filesystem::path& path);

}  // namespace drillstrand
