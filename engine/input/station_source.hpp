/// A survey as it is written somewhere: its stations row by row.
#pragma once

#include <cstddef>
#include <string>

#include "drillstrand/error.hpp"

namespace drillstrand {

class StationSource {
  public:
    enum Part { measured_depth, inclination, azimuth };

    StationSource() = default;
    StationSource(const StationSource&) = delete;
    StationSource& operator=(const StationSource&) = delete;
    virtual ~StationSource() = default;

    [[nodiscard]] virtual std::size_t count() const = 0;
    /// In SI. Throws InputError where it is no finite number.
    [[nodiscard]] virtual double value(std::size_t row, Part part) const = 0;
    /// As it is written, without its unit.
    [[nodiscard]] virtual std::string text(std::size_t row, Part part) const = 0;
    /// "m" where none is written.
    [[nodiscard]] virtual std::string depth_unit(std::size_t row) const = 0;
    [[nodiscard]] virtual SourceLocation where(std::size_t row, Part part) const = 0;
};

}  // namespace drillstrand
