/// Any bytes as a quantity and as a unit, the first byte choosing the dimension: a finite number,
/// or words that say what is wrong.
#include "drillstrand/units.hpp"

#include <array>
#include <cmath>
#include <stdexcept>

#include "fuzz/fuzz_folder.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace drillstrand;
    constexpr std::array dimensions{dimension::none,
                                    dimension::length,
                                    dimension::time,
                                    dimension::frequency,
                                    dimension::acceleration,
                                    dimension::force,
                                    dimension::moment,
                                    dimension::pressure,
                                    dimension::viscosity,
                                    dimension::density,
                                    dimension::linear_density,
                                    dimension::curvature,
                                    dimension::bending_stiffness,
                                    dimension::inertia_per_length};
    if (size == 0) return 0;
    const Dimension& expected = dimensions[data[0] % dimensions.size()];
    const bool is_header = data[0] >= 0x80U;
    const std::string_view text = fuzz::text_of(data + 1, size - 1);
    try {
        const double value =
            is_header ? unit_factor(text, expected) : parse_quantity(text, expected);
        if (!std::isfinite(value) || (is_header && value <= 0)) std::abort();
    } catch (const std::invalid_argument& error) {
        if (error.what()[0] == '\0') std::abort();
    }
    return 0;
}
