/// Scenes for the kernels: the string of Well 2 on any mesh, with the physics a benchmark asks for.
#pragma once

#include "drillstrand/scene.hpp"
#include "numerics/block_table.hpp"
#include "plain_strand.hpp"
#include "rod/strand.hpp"

namespace drillstrand::bench {

/// Scene of cases/well2_drilling_paper.toml with so many segments. Without a well the string hangs
/// free; without damping D_in = 0. `offset` (m) shifts it from the well's axis toward the wall.
Scene make_scene(int segments, const SceneFeatures& features, double offset = 0);

/// A state off balance, the same every time: speeds of centimetres per second, and so little
/// bending that the string stays near the wall, some nodes in contact and some not.
PlainState perturbed_state(const Scene& scene);

/// The same numbers in the engine's layout.
Table<StrandRow> to_table(const PlainState& state);

/// Largest difference between momentum rates, stress rates (each row for itself) of the two
/// layouts, relative to the row's largest rate.
double relative_difference(const PlainState& plain, const Table<StrandRow>& table);

}  // namespace drillstrand::bench
