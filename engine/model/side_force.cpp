#include "drillstrand/side_force.hpp"

#include <algorithm>
#include <cstddef>

namespace drillstrand {

namespace {

/// Ends of the nodes' cells, and the force of the wall from the head to each of them.
struct CumulativeForce {
    CumulativeForce(const std::vector<double>& node_s, const std::vector<double>& normal_force) {
        bound.push_back(node_s.front());
        force.push_back(0);
        for (std::size_t k = 0; k < node_s.size(); ++k) {
            bound.push_back(k + 1 < node_s.size() ? 0.5 * (node_s[k] + node_s[k + 1])
                                                  : node_s.back());
            force.push_back(force.back() + normal_force[k] * (bound.back() - bound[k]));
        }
    }

    [[nodiscard]] double up_to(double s) const {
        const auto next = std::upper_bound(bound.begin() + 1, bound.end() - 1, s);
        const auto k = static_cast<std::size_t>(next - bound.begin());
        const double length = bound[k] - bound[k - 1];
        const double share = length > 0 ? (s - bound[k - 1]) / length : 0.0;
        return force[k - 1] + share * (force[k] - force[k - 1]);
    }

    std::vector<double> bound;  ///< m
    std::vector<double> force;  ///< N
};

}  // namespace

std::vector<double> side_force(const std::vector<double>& node_s,
                               const std::vector<double>& normal_force, double window,
                               const std::vector<double>& at) {
    const CumulativeForce sum(node_s, normal_force);
    std::vector<double> mean;
    mean.reserve(at.size());
    for (const double s : at) {
        const double from = std::max(s - window / 2, node_s.front());
        const double to = std::min(s + window / 2, node_s.back());
        mean.push_back((sum.up_to(to) - sum.up_to(from)) / (to - from));
    }
    return mean;
}

}  // namespace drillstrand
