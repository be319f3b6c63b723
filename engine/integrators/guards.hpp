/// Physical guards: reasons to stop a run whose numbers are sound. Where the string would have
/// failed long before, or the mesh cannot follow its motion, results would mislead.
/// Criteria: engine/integrators/README.md, "Guards".
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "drillstrand/scene.hpp"
#include "numerics/block_table.hpp"
#include "rod/director.hpp"
#include "rod/jar.hpp"

namespace drillstrand {

/// The worst of some segments, by each guard's own measure.
struct GuardReading {
    double cosine = 1;      ///< least cosine of the angle between the directors of a segment
    double yield2 = 0;      ///< largest square of von Mises stress / yield strength
    double coarseness = 0;  ///< largest (h / helical pitch)^2 under the segment's compression
};

/// The coarser of two; of equals the one met first.
CoarsestSegment coarser_of(const CoarsestSegment& one, const CoarsestSegment& other);

class Guards {
  public:
    /// `stress_limit`: multiple of yield at which to stop; 0: none.
    Guards(const Scene& scene, const DirectorModel& model, double stress_limit);

    /// Reads a block of segments. Their twists, and the jar's slide, must belong to the same whole
    /// step as `rod`.
    [[nodiscard]] GuardReading read(const Table<DirectorRow>& rod,
                                    const Table<SegmentRow>& segments, const JarState& jar,
                                    std::size_t block) const;

    [[nodiscard]] bool stops(const GuardReading& reading) const;

    /// Why a run has to stop: the first segment from the head that no guard lets pass.
    [[nodiscard]] std::optional<std::string> describe(const Table<DirectorRow>& rod,
                                                      const Table<SegmentRow>& segments,
                                                      const JarState& jar, double time) const;

    /// Keeps the coarsest segment of a block if it is coarser than `coarsest`.
    void follow(CoarsestSegment& coarsest, const GuardReading& reading,
                const Table<DirectorRow>& rod, const Table<SegmentRow>& segments,
                const JarState& jar, std::size_t block, double time) const;

    /// A sentence on a mesh that resolves its buckle poorly; none where it is fine enough.
    [[nodiscard]] std::optional<std::string> warn(const CoarsestSegment& coarsest) const;

    /// Constants of the segments in the layout of the kernel.
    enum Row : std::size_t {
        axial_yield,    // 1 / axial yield load (1/N)
        bending_yield,  // 1 / bending yield load (1/(N m))
        torsion_yield,  // 1 / torsional yield load (1/(N m))
        inverse_pitch,  // h^2 / (8 pi^2 EI): (h / pitch)^2 for a compression (1/N)
        rows
    };

  private:
    struct BlockReadings;
    [[nodiscard]] BlockReadings readings(const Table<DirectorRow>& rod,
                                         const Table<SegmentRow>& segments, const JarState& jar,
                                         std::size_t block) const;
    [[nodiscard]] std::string place(std::size_t segment) const;
    [[nodiscard]] std::string buckle(double coarseness, std::size_t segment) const;

    const Scene& scene_;
    const DirectorModel& model_;
    Jar jar_;
    BlockTable limits_;
    double most_yield2_;
};

}  // namespace drillstrand
