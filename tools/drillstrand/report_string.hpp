/// The string along its length, over the profiles of a run: what maps, profiles, orbits and the
/// three-dimensional view of a page draw.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "drillstrand/result_file.hpp"
#include "report_data.hpp"

namespace drillstrand::program {

/// At most `most` of `count` indices: every k-th, and the last.
std::vector<std::size_t> pick_evenly(std::size_t count, std::size_t most);

/// Von Mises stress over yield strength at the outer fibre of a segment; not a number where the
/// file does not know the yield loads. Axial force as recorded, that is without the pressures of
/// the fluid.
double yield_share(const ResultHeader& header, std::size_t segment, const Vector6& stress);

/// Adds the arrays of the string, and to `notes` what was left out to keep the page small.
void add_string(const Result& result, ArrayBlock& arrays, std::vector<std::string>& notes);

}  // namespace drillstrand::program
