/// Checkpoints (HDF5): a run in the middle, from which it goes on as if it had never been left.
/// The layout is listed in engine/results/README.md.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "drillstrand/result_file.hpp"
#include "drillstrand/saved_state.hpp"

namespace drillstrand {

struct Checkpoint {
    ResultHeader header;       ///< of the result file that the run writes
    std::string version;       ///< of the drillstrand that wrote it; set by reading
    std::string commit;        ///< likewise
    double time = 0;           ///< simulated (s)
    double wall_seconds = 0;   ///< that the run has taken
    std::size_t series = 0;    ///< records in the result file
    std::size_t profiles = 0;  ///< likewise
    SavedState state;          ///< of the integrator
    SavedState summary;        ///< of what the program says at the end
    SavedState scene;          ///< what `header` says of string and well; set by reading
};

/// The checkpoint of a result file: its name with .checkpoint.h5 for its ending.
std::filesystem::path checkpoint_path(const std::filesystem::path& result);

/// Where the checkpoint before the last is kept.
std::filesystem::path previous_checkpoint_path(const std::filesystem::path& checkpoint);

/// Writes a checkpoint: the new file takes its name when the disk has it, the one before is kept
/// under previous_checkpoint_path(). Throws WriteError where that fails; the checkpoints that were
/// there then still are.
void write_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint);

/// Whether a file is a checkpoint. Throws ResultError where there is no result file to read.
bool holds_checkpoint(const std::filesystem::path& path);

/// Throws ResultError where the file is not a sound checkpoint.
Checkpoint read_checkpoint(const std::filesystem::path& path);

/// Throws ResultError, with the first thing that differs, where a run with this header and program
/// is not the one of the checkpoint.
/// `same_bits_everywhere`: the instruction set does not matter.
void require_same_run(const std::filesystem::path& path, const Checkpoint& checkpoint,
                      const ResultHeader& header, bool same_bits_everywhere);

}  // namespace drillstrand
