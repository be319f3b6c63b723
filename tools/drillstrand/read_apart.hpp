/// Reading a file in a process of its own. The HDF5 library can crash, loop and take all memory on
/// files made for it (engine/results/README.md, "What the reader refuses"); this way it is one line
/// and an exit code. What arrives here went through a pipe as plain numbers and text.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>
#include <variant>

#include "drillstrand/buckling_file.hpp"
#include "drillstrand/checkpoint.hpp"
#include "drillstrand/modes_file.hpp"
#include "drillstrand/result_file.hpp"
#include "drillstrand/torque_drag_file.hpp"

namespace drillstrand::program {

/// What a file holds, by the command that wrote it.
using Contents = std::variant<Result, BucklingResult, TorqueDragResult, ModesResult>;

/// Throws ResultError where the file cannot be read, or reading it crashes, takes longer than any
/// sound file of its size, or more memory.
Contents read_apart(const std::filesystem::path& path);

/// read_checkpoint(), which throws in the same cases too.
Checkpoint read_checkpoint_apart(const std::filesystem::path& path);

/// is_own_result(); false where it cannot tell, since then nobody should write over the file.
bool is_own_result_apart(const std::filesystem::path& path);

/// In words what a file of another command than run and equilibrium holds; none for theirs.
std::optional<std::string_view> other_than_run(const Contents& contents);

}  // namespace drillstrand::program
