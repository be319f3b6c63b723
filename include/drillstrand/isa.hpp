/// Instruction sets for which the engine's vector kernels are compiled.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace drillstrand {

/// Levels in ascending order. `baseline` is what the compiler was told for all code; where only one
/// version of the kernels is compiled, that is the only level.
enum class Isa { baseline, avx2, avx512 };

/// The highest level that has kernels in this build and runs on this machine.
Isa best_isa();

/// Which version of the kernels an integrator uses.
struct Level {
    Isa isa = best_isa();
    /// The same bits on every level: no product and sum in one rounding (FMA), which the lowest
    /// level lacks.
    bool reproducible = false;
};

/// The levels up to best_isa().
std::vector<Isa> available_isas();

/// As on the command line and in result files: "baseline", "avx2", "avx512".
std::string isa_name(Isa isa);
std::optional<Isa> isa_from_name(std::string_view name);

}  // namespace drillstrand
