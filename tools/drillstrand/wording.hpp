/// Numbers as people read them.
#pragma once

#include <cstddef>
#include <string>

#include "drillstrand/units.hpp"

namespace drillstrand::program {

// Units that messages use, in SI.
inline const double kilonewton = unit_factor("kN", dimension::force);
inline const double kilonewton_metre = unit_factor("kN m", dimension::moment);
inline const double kilonewton_per_metre = unit_factor("kN/m", {1, 0, -2});
inline const double megapascal = unit_factor("MPa", dimension::pressure);
inline const double millimetre = unit_factor("mm", dimension::length);
inline const double revolution_per_minute = unit_factor("rpm", dimension::frequency);

/// "0.41 s", "42 s", "3 min 20 s", "2 h 05 min", "3.2 days".
std::string duration_text(double seconds);

/// "731", "12 400", "5.1e+07" from a million on.
std::string count_text(double count);

/// Item `k` of a list of units as result files write it, "N m, N m, N", or the one unit of all.
std::string unit_of(const std::string& units, std::size_t k);

/// A finding of a run, "subject: what", in its two parts; the subject is empty where it has none.
struct FindingText {
    std::string subject;
    std::string what;
};
FindingText finding_text(const std::string& finding);

}  // namespace drillstrand::program
