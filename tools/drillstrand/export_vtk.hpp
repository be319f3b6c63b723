/// A result as VTK files, which ParaView opens as a time series.
#pragma once

#include <filesystem>
#include <vector>

#include "drillstrand/new_file.hpp"
#include "drillstrand/result_file.hpp"

namespace drillstrand::program {

/// Writes string.pvd, the collection of the profiles, one string_NUMBER.vtp per profile and, where
/// the well is known, well.vtp into an existing folder. Coordinates are those of the result file:
/// north, east, down. Throws ResultError where a file cannot be written.
///
/// VTK gives a cell one value per array, so the string is a line cell per segment, with the
/// segment's stress; the well is a polyline per diameter of the hole, with the radius at its
/// points. Format: "VTK XML formats", VTK 9 documentation.
void write_vtk(const std::filesystem::path& folder, const Result& result, Existing existing);

/// What it would write.
std::vector<std::filesystem::path> vtk_files(const std::filesystem::path& folder,
                                             const Result& result);

}  // namespace drillstrand::program
