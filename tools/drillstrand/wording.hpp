/// Numbers as people read them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "drillstrand/case.hpp"
#include "drillstrand/units.hpp"

namespace drillstrand::program {

// Units that messages use, in SI. Functions, since a compiler need not have a variable of one file
// ready when another's is made before main().
inline double kilonewton() {
    return unit_factor("kN", dimension::force);
}
inline double kilonewton_metre() {
    return unit_factor("kN m", dimension::moment);
}
inline double kilonewton_per_metre() {
    return unit_factor("kN/m", {1, 0, -2});
}
inline double megapascal() {
    return unit_factor("MPa", dimension::pressure);
}
inline double millimetre() {
    return unit_factor("mm", dimension::length);
}
inline double hertz() {
    return unit_factor("Hz", dimension::frequency);
}
inline double revolution_per_minute() {
    return unit_factor("rpm", dimension::frequency);
}

/// "0.41 s", "42 s", "3 min 20 s", "2 h 05 min", "3.2 days".
std::string duration_text(double seconds);

/// "731", "12 400", "5.1e+07" from a million on.
std::string count_text(double count);

/// Item `k` of a list of units as result files write it, "N m, N m, N", or the one unit of all.
std::string unit_of(const std::string& units, std::size_t k);

/// "at rest, without friction", "tripping in" and so on.
std::string_view motion_word(StringMotion motion);

/// A finding of a run, "subject: what", in its two parts; the subject is empty where it has none.
struct FindingText {
    std::string subject;
    std::string what;
};
FindingText finding_text(const std::string& finding);

}  // namespace drillstrand::program
