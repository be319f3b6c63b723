/// Rainflow counting of a signal that goes on (engine/simulation/README.md, "Cycles").
#pragma once

#include <vector>

namespace drillstrand {

/// Cycles of a signal: how many, the largest range, and the range of which as many do the damage of
/// all, (sum n S^m / sum n)^(1/m).
struct CycleCount {
    double cycles = 0;
    double largest_range = 0;
    double equivalent_range = 0;
};

/// The count of ASTM E1049-85 (2017), 5.4.4, of values as they come. Ranges that differ by no more
/// than `resolution` count as equal, and turns of no more are none: so it remembers no more
/// than (largest range)/resolution values.
class RainflowCounter {
  public:
    /// `slope`: m.
    RainflowCounter(double slope, double resolution) : slope_(slope), resolution_(resolution) {}

    void add(double value);

    /// Of all so far: ranges that are open count as halves.
    [[nodiscard]] CycleCount count() const;
    /// sum n S^m of the same.
    [[nodiscard]] double damage() const;

    /// All that it remembers; restore() throws std::invalid_argument where that is something else.
    [[nodiscard]] std::vector<double> save() const;
    void restore(const std::vector<double>& saved);

  private:
    struct Sum {
        double cycles = 0;
        double damage = 0;
        double largest = 0;
    };

    void turn_at(double value);
    /// Counts a range.
    void close(double range, double cycles);
    /// As if the signal ended here: open ranges are halves.
    [[nodiscard]] Sum total() const;

    double slope_;
    double resolution_;
    Sum closed_;
    std::vector<double> turns_;  ///< whose ranges are open: each is less than the one before
    bool empty_ = true;
    double way_ = 0;      ///< since the last turn: 1 up, -1 down; 0 before the first
    double extreme_ = 0;  ///< since then
};

}  // namespace drillstrand
