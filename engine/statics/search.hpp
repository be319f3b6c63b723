/// The search for the equilibrium of a scene: which loads to put on in which order, and how to get
/// past points where the string buckles.
#pragma once

#include <string>
#include <vector>

#include "drillstrand/equilibrium.hpp"
#include "statics/balance.hpp"
#include "statics/newton.hpp"
#include "statics/rod_state.hpp"

namespace drillstrand {

class EquilibriumSearch {
  public:
    EquilibriumSearch(const Scene& scene, const EquilibriumOptions& options);

    /// Throws SimulationError where there is none to be found.
    void run();

    [[nodiscard]] const RodState& state() const { return state_; }
    [[nodiscard]] Balance& balance() { return balance_; }
    [[nodiscard]] int iterations() const { return newton_.iterations(); }
    [[nodiscard]] bool is_stable() const { return stable_; }
    [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }
    /// The largest force out of balance (N).
    [[nodiscard]] double residual();

  private:
    /// Loads that are put on together, from 0 to their full size.
    enum class Stage { weight, bit, friction };
    [[nodiscard]] LoadCase loads_at(Stage stage, double factor) const;

    void settle_in_well();
    void settle_at_rest();
    void settle_moving();
    bool settle_moving_at_once();
    [[nodiscard]] std::vector<double> wall_stiffnesses() const;
    void settle_free();
    void put_on(Stage stage);
    [[nodiscard]] bool is_sound(const BlockFactors& factors) const;
    void report_buckling(Stage stage, RodState state, double sound, double unsound);
    void look_for_buckling();
    void fall_to_stable();
    void refuse_folded_segments() const;
    [[noreturn]] void fail();

    const Scene& scene_;
    EquilibriumOptions options_;
    LoadCase full_;
    bool conservative_;
    Balance balance_;
    Newton newton_;
    RodState state_;
    bool stable_ = true;
    std::vector<std::string> warnings_;
};

}  // namespace drillstrand
