/// WITSML 1.4.1.1 (Energistics): a file of one data object, its elements and their places.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "drillstrand/error.hpp"
#include "drillstrand/units.hpp"

namespace drillstrand {

/// Whether a file is read as WITSML: its name ends with .xml.
bool is_witsml(const std::filesystem::path& path);

/// Elements are found by their names without a prefix of namespace.
class WitsmlFile {
  public:
    /// Throws InputError where the file is not XML, has a DOCTYPE, or is no WITSML 1.4.1.1 with
    /// exactly one object of this name, as in <trajectorys version="1.4.1.1"><trajectory>; at
    /// `asked_at` where it cannot be read.
    WitsmlFile(const std::filesystem::path& path, const SourceLocation& asked_at,
               const std::string& object);

    [[nodiscard]] pugi::xml_node object() const { return object_; }
    [[nodiscard]] static std::vector<pugi::xml_node> children(pugi::xml_node node,
                                                              std::string_view name);
    /// Throws InputError at `node` where it has no such child, or several.
    [[nodiscard]] pugi::xml_node require(pugi::xml_node node, std::string_view name) const;
    [[nodiscard]] std::optional<std::string> text(pugi::xml_node node, std::string_view name) const;
    /// The number of an element in SI by its attribute uom. Throws InputError where it is no finite
    /// number or has no unit of this dimension.
    [[nodiscard]] double quantity(pugi::xml_node element, const Dimension& dimension) const;
    /// Number and unit of an element as they are written: "100 ft".
    [[nodiscard]] static std::string written(pugi::xml_node element);
    [[nodiscard]] SourceLocation where(pugi::xml_node node) const;

  private:
    [[nodiscard]] SourceLocation place(std::ptrdiff_t offset) const;
    void parse();
    void find_object(const std::string& name);

    std::string file_;
    std::string text_;
    std::vector<std::size_t> line_starts_;
    pugi::xml_document document_;
    pugi::xml_node object_;
};

/// Text of an element, without the blanks around it.
std::string content_of(pugi::xml_node element);

}  // namespace drillstrand
