#include "drillstrand/isa.hpp"

#include <algorithm>
#include <array>

#include "numerics/kernel.hpp"

namespace drillstrand {

namespace {

constexpr std::array<const char*, 3> names = {"baseline", "avx2", "avx512"};

}  // namespace

Isa best_isa() {
#if defined(DRILLSTRAND_LEVELS)
    if (__builtin_cpu_supports("x86-64-v4")) return Isa::avx512;
    if (__builtin_cpu_supports("x86-64-v3")) return Isa::avx2;
#endif
    return Isa::baseline;
}

std::vector<Isa> available_isas() {
    std::vector<Isa> isas;
    for (int level = 0; level <= static_cast<int>(best_isa()); ++level)
        isas.push_back(static_cast<Isa>(level));
    return isas;
}

std::string isa_name(Isa isa) {
    return names[static_cast<std::size_t>(isa)];
}

std::optional<Isa> isa_from_name(std::string_view name) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) return std::nullopt;
    return static_cast<Isa>(found - names.begin());
}

}  // namespace drillstrand
