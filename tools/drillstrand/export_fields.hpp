/// The quantities of a profile as named columns with units, for every format of drillstrand export.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "drillstrand/records.hpp"
#include "drillstrand/result_file.hpp"
#include "drillstrand/well.hpp"

namespace drillstrand::program {

/// One quantity of every node or segment.
struct ExportField {
    std::string name;
    std::string units;                    ///< "1": none
    std::vector<std::string> components;  ///< names; empty: one value per row
    std::vector<double> values;           ///< row by row

    [[nodiscard]] std::size_t width() const { return components.empty() ? 1 : components.size(); }
};

/// north, east, down
const std::vector<std::string>& space_components();

/// The components of a stress as result files order them.
const std::vector<std::string>& stress_components();

/// "name[units]", and "name" where there are none.
std::string with_units(const std::string& name, const std::string& units);

/// Takes the quantities of profiles out of a result. The result must outlive it.
class ProfileFields {
  public:
    explicit ProfileFields(const Result& result);

    /// Everything the file knows of the nodes but their positions, and what follows from it: spin
    /// where the inertia is known, the offset from the axis where the well is.
    [[nodiscard]] std::vector<ExportField> of_nodes(const Profile& profile);
    [[nodiscard]] std::vector<ExportField> of_segments(const Profile& profile) const;

  private:
    [[nodiscard]] ExportField offset(const Profile& profile);

    const Result& result_;
    std::optional<Well> well_;
    std::vector<std::size_t> arcs_;  ///< that held the nodes in the last profile
};

/// A stretch of the well's axis on which the hole has one diameter.
struct WellStretch {
    double radius = 0;  ///< of the hole (m)
    std::vector<double> measured_depth;
    std::vector<Eigen::Vector3d> axis;  ///< m
};

/// The axis from the top of the survey, or of the string, to the deeper one of their ends, in
/// chords that turn by a degree at most. Empty without a well.
std::vector<WellStretch> well_stretches(const Result& result);

}  // namespace drillstrand::program
