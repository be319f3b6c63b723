/// What the last part of a run says of its bit, of whirl and of the weight that the walls carry.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "drillstrand/records.hpp"
#include "drillstrand/saved_state.hpp"
#include "drillstrand/scene.hpp"

namespace drillstrand {

/// How the bit turned and pressed (engine/results/README.md, "Findings").
struct BitConduct {
    double stick_slip_index = 0;  ///< infinite of a bit that hardly turns
    double stuck = 0;             ///< share of the time in which it stands still or turns back
    double unloaded = 0;          ///< share of the time in which it carries no load
    double least_rate = 0;        ///< rad/s, positive with the head, as the next two
    double most_rate = 0;         ///< rad/s
    double mean_rate = 0;         ///< rad/s
    double least_load = 0;        ///< N, compression of the last segment
    double most_load = 0;         ///< N
};

/// Holds the last third of a run, 30 s of it at most: what comes after the last point of its
/// schedules, once the run is past that. Records that follow another by less than 10 ms do not
/// count.
class LastPart {
  public:
    /// Nothing before `start` counts (s).
    LastPart(const Scene& scene, double start);

    void add(const SeriesRecord& record);

    /// A line each, "subject: what": of a bit that a rotating head turns, of one with weight on it,
    /// and of what the string does in a well. None before there is a second record.
    [[nodiscard]] std::vector<std::string> findings() const;
    /// A sentence each, of a part of a second at least: a string of which more than 0.3 goes around
    /// backward (less what goes around forward); and, under constant loads on a rotating string,
    /// walls that carry more than 0.2 of the weight on bit and 0.02 of the hook load.
    [[nodiscard]] std::vector<std::string> warnings() const;

    /// Of its first three numbers, 0 those of a head that does not rotate, or of no weight on bit.
    [[nodiscard]] BitConduct bit() const;

    /// All of it as a row; restore() throws std::invalid_argument where there is none.
    [[nodiscard]] SavedState save() const;
    void restore(const SavedState& saved);

    /// What counts of a record, or the mean of that.
    struct Sample {
        double time = 0;           ///< s
        double forward = 0;        ///< share of the string
        double backward = 0;       ///< share of the string
        double whirl_rate = 0;     ///< times the share that whirls (rad/s)
        double rolling_rate = 0;   ///< times the share that whirls (rad/s)
        double whirl_depth = 0;    ///< times the share that whirls (m)
        double kinetic = 0;        ///< J
        double rotation = 0;       ///< J
        double drag = 0;           ///< N
        double drag_size = 0;      ///< N
        double drag_depth = 0;     ///< times the size of the drag (N m)
        double hook_load = 0;      ///< N
        double weight_on_bit = 0;  ///< N
        double rotation_rate = 0;  ///< of the head, size (rad/s)
        double bit_rate = 0;       ///< positive with the head (rad/s)
        double bit_load = 0;       ///< compression of the last segment (N)
    };

  private:
    [[nodiscard]] Sample mean() const;
    /// From the first to the last sample (s).
    [[nodiscard]] double duration() const;
    [[nodiscard]] std::string when() const;
    [[nodiscard]] bool is_steady() const { return samples_.front().time >= loads_change_until_; }

    bool well_;
    double start_;               ///< s
    double loads_change_until_;  ///< s
    std::deque<Sample> samples_;
};

}  // namespace drillstrand
