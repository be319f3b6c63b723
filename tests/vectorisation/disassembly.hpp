/// What an object file's kernels compute with, read from objdump.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace drillstrand::test {

/// Arithmetic (add, subtract, multiply, divide, square root, fused multiply-add, minimum, maximum)
/// in one version of a kernel. Entries are as many as doubles have room: two floats count as one.
struct VectorUse {
    int packed_entries = 0;  ///< entries of all packed instructions: 2, 4 or 8 each
    int scalar_entries = 0;  ///< scalar instructions, one entry each
    int widest = 1;          ///< entries of the widest packed instruction
    int fused = 0;           ///< fused multiply-adds, packed or scalar
    int calls = 0;           ///< of other functions

    [[nodiscard]] double packed_share() const {
        return packed_entries == 0
                   ? 0.0
                   : static_cast<double>(packed_entries) / (packed_entries + scalar_entries);
    }
};

/// One of the functions that the compiler makes of a kernel.
struct KernelVersion {
    std::string level;     ///< as isa_name(), with "_unfused" where reproducible
    std::string function;  ///< with the arguments of its template
    VectorUse use;
};

/// The versions of all kernels in object files, by "FILE: KERNEL" without the file's extension.
/// `objects` are paths as a shell takes them. Throws std::runtime_error where objdump fails.
using Kernels = std::map<std::string, std::vector<KernelVersion>>;
Kernels read_kernels(const std::string& objdump, const std::string& objects);

}  // namespace drillstrand::test
