/// The tables of a case file, each read into its part of the case. Every function takes the root
/// table and throws InputError at the key where something is wrong.
#pragma once

#include <filesystem>
#include <vector>

#include "drillstrand/case.hpp"
#include "input/component_reader.hpp"
#include "input/table.hpp"

namespace drillstrand {

/// The string and, for each component, the place to name in messages.
struct StringInput {
    StringCase string;
    std::vector<SourceLocation> component_places;
    std::vector<WrittenValue> masses;  ///< of each component, as written
    std::vector<WrittenValue> moduli;  ///< likewise; without a path where left out
    SourceLocation where;
};

// Paths in the tables are relative to `folder`.
std::optional<WellCase> read_well(const Table& root, const std::filesystem::path& folder);
std::optional<FluidCase> read_fluid(const Table& root);
StringInput read_string(const Table& root, const std::filesystem::path& folder);
MeshCase read_mesh(const Table& root, const StringCase& string);
HeadCase read_head(const Table& root);
/// Needs what is pumped, which drives a motor.
BitCase read_bit(const Table& root, const StringCase& string,
                 const std::optional<FluidCase>& fluid);
ContactCase read_contact(const Table& root);
DampingCase read_damping(const Table& root);
/// `can_rest`: whether an equilibrium can be found, so that a run starts from it unless told
/// otherwise.
InitialCase read_initial(const Table& root, bool can_rest);
EquilibriumCase read_equilibrium(const Table& root);
RunCase read_run(const Table& root);
/// Needs the duration of the run, which bounds the number of records (0: none), and the string, in
/// which sensors have their places.
OutputCase read_output(const Table& root, double duration, const StringCase& string);
/// Needs the well and the string, whose place at each depth is checked.
TorqueDragCase read_torque_drag(const Table& root, const std::optional<WellCase>& well,
                                const StringInput& string, double interference);

/// Fails where a key stands that only another choice of a word uses.
void refuse_key(const Table& table, std::string_view key, std::string_view choice);

/// One coefficient for both directions, or [axial, azimuthal].
FrictionCoefficients read_friction(const Value& value);

/// Dynamic coefficients: as given, at most the static ones; left out, the usual ones or the static
/// ones where those are less.
FrictionCoefficients read_dynamic_friction(const std::optional<Value>& value,
                                           const FrictionCoefficients& standing,
                                           const FrictionCoefficients& usual);

/// Throws InputError where the string is longer than the surveyed well or where a component, at
/// its place below a head at the start of the well, is wider than the hole by more than an
/// interference (m). A head elsewhere leaves the depths open: then lengths alone are compared.
void check_fit(const WellCase& well, const StringInput& input, const HeadCase& head,
               double interference);

/// Throws InputError at `where` where a component of the string, its bit at a measured depth and
/// its top component as long as that takes, is wider than the hole by more than that.
void check_fit_at(const WellCase& well, const StringInput& input, double interference,
                  double bit_depth, const SourceLocation& where);

}  // namespace drillstrand
