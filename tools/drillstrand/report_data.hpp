/// What a page carries: numbers as one block of little-endian arrays, and JSON that describes them.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace drillstrand::program {

/// Values of JSON, as text.
std::string json_text(std::string_view text);
std::string json_number(double value);  ///< null where it is not finite
std::string json_list(const std::vector<std::string>& values);
/// An object of values that are JSON already, in the order given.
std::string json_object(const std::vector<std::pair<std::string, std::string>>& members);

/// Named arrays of numbers. The first extent of a shape is the slowest.
class ArrayBlock {
  public:
    using Shape = std::vector<std::size_t>;

    /// Stored in single precision: seven digits, which is more than a page prints.
    void add(const std::string& name, const std::vector<double>& values, Shape shape = {});
    /// Stored in double precision, for times and depths.
    void add_exact(const std::string& name, const std::vector<double>& values);

    [[nodiscard]] std::string base64() const;
    /// {"NAME": {"type": "f32", "shape": [2, 3], "offset": 0}, ...}, offsets in bytes.
    [[nodiscard]] std::string json() const;

  private:
    template <class Stored>
    void append(const std::string& name, const char* type, const std::vector<double>& values,
                Shape shape);

    std::string bytes_;
    std::vector<std::pair<std::string, std::string>> entries_;
};

}  // namespace drillstrand::program
