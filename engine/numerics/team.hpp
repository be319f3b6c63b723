/// How many threads a run puts to work on a machine that others use too.
#pragma once

#include <cstdint>
#include <limits>

namespace drillstrand {

/// Threads that meet at every step lose whole slices of time wherever one of them has to share its
/// core: two can be ten times slower than one. A team therefore works only as long as its members
/// hardly ever wait for a late one; where they do, one thread goes on alone, and the team tries
/// again later, less and less often. Results do not depend on who computes them.
///
/// Times are wall times in seconds, of any one clock.
class Team {
  public:
    explicit Team(int members) : members_(members) {}

    [[nodiscard]] int members() const { return members_; }

    /// Threads for the work that begins now.
    [[nodiscard]] int size(double now) const { return now < alone_until_ ? 1 : members_; }

    /// Steps after which to ask again.
    [[nodiscard]] std::int64_t longest_piece(double now) const {
        return size(now) < members_ ? steps_alone : std::numeric_limits<std::int64_t>::max();
    }

    /// Whether a team that began to work at `start`, and has waited for late members for that long
    /// since, should stop.
    [[nodiscard]] bool waits_too_long(double start, double now, double waited) const;

    /// The team has worked from `start` to `now` and waited for late members for that long in
    /// between.
    void worked(double start, double now, double waited);

  private:
    static constexpr std::int64_t steps_alone = 1000;
    static constexpr double window = 0.05;          ///< s, over which waiting is compared with work
    static constexpr double most_waiting = 0.002;   ///< s; more than a stray interruption
    static constexpr double bearable_share = 0.1;   ///< of the time
    static constexpr double shortest_pause = 0.02;  ///< s
    static constexpr double longest_pause = 2;      ///< s

    int members_;
    double time_ = 0;    ///< worked in this window (s)
    double waited_ = 0;  ///< in this window (s)
    double alone_until_ = -std::numeric_limits<double>::infinity();
    double pause_ = shortest_pause;
};

}  // namespace drillstrand
