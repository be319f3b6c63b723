/// Components of the string, from the case file's tables or from a table of their own.
#pragma once

#include <filesystem>
#include <vector>

#include "drillstrand/case.hpp"
#include "drillstrand/error.hpp"
#include "input/value.hpp"
#include "input/written.hpp"

namespace drillstrand {

/// A component and the place to name where it does not fit the rest of the case.
struct PlacedComponent {
    Component component;
    SourceLocation where;
    WrittenValue mass = {};     ///< its linear_density or density
    WrittenValue modulus = {};  ///< its youngs_modulus
};

/// The list [[string.component]].
std::vector<PlacedComponent> read_component_list(const Value& list);

/// A CSV file of components, or a tubular in WITSML where its name ends with .xml. Throws
/// InputError at the field where the table is wrong, at `asked_at` (the key that names the file)
/// where it cannot be read.
std::vector<PlacedComponent> read_component_file(const std::filesystem::path& path,
                                                 const SourceLocation& asked_at);

}  // namespace drillstrand
