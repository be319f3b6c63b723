/// A jar on the director rod: one segment whose axial spring acts at its stops alone while it is
/// released (engine/rod/README.md, "Jar"). Its own constants and its state (JarState,
/// state/rows.hpp).
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "drillstrand/drill_string.hpp"
#include "numerics/block_table.hpp"
#include "rod/director.hpp"
#include "state/rows.hpp"

namespace drillstrand {

class Jar {
  public:
    explicit Jar(const StringMesh& mesh);

    /// Whether the string has a jar, in a segment of these blocks.
    [[nodiscard]] bool is_in(BlockSpan span) const {
        return jar_ && jar_->segment / block_size >= span.begin &&
               jar_->segment / block_size < span.end;
    }
    /// Number of its segment; none without a jar.
    [[nodiscard]] std::optional<std::size_t> segment() const {
        return jar_ ? std::optional(jar_->segment) : std::nullopt;
    }

    /// The jar at a whole step from that at the one before, `drift` (s) ago: latched, sliding or at
    /// a stop under the places and directors of `rod`. Followed again at the same step it stays.
    [[nodiscard]] JarState follow(JarState jar, const DirectorModel& model,
                                  const Table<DirectorRow>& rod, double drift) const;

    /// Takes from the forces of its segment, as director_segments() left them, what the slide has
    /// made slack.
    void slacken(const JarState& jar, const DirectorModel& model, const Table<DirectorRow>& rod,
                 Table<SegmentRow>& segments) const;

    /// Slide over length of a segment, 0 of all but its own.
    [[nodiscard]] double slid(const JarState& jar, std::size_t segment) const {
        return jar_ && jar_->segment == segment ? jar.slide / length_ : 0.0;
    }
    /// The same of the segments of a block.
    [[nodiscard]] std::array<double, block_size> slid_in(const JarState& jar,
                                                         std::size_t block) const;

    /// Throws std::invalid_argument where a restored state is none of this jar.
    void check(const JarState& jar) const;

  private:
    /// Whether its halves are between the stops: nothing then holds them along the axis.
    [[nodiscard]] bool is_free(const JarState& jar) const {
        return jar.released != 0 && jar.slide > -jar_->law.down_travel &&
               jar.slide < jar_->law.up_travel;
    }
    /// Latched: counts for how long (s) a force has been above its limit, and trips.
    void meter(JarState& jar, double tension, double drift) const;
    /// Released: the halves are where their segment has them (m), or at a stop.
    void slide_to(JarState& jar, double place) const;
    /// 1 where a tension (N) is above its limit, -1 where a compression is, else 0.
    [[nodiscard]] double way_of(double tension) const;

    std::optional<StringMesh::Jar> jar_;
    double length_ = 1;  ///< of its segment (m)
};

}  // namespace drillstrand
