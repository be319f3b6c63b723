/// Random numbers of tests, the same in every run.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <random>

namespace drillstrand::test {

class Dice {
  public:
    explicit Dice(unsigned seed) : engine_(seed) {}
    /// Evenly between two numbers.
    double between(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(engine_);
    }
    /// Evenly in the logarithm.
    double decades(double low, double high) {
        return std::exp(between(std::log(low), std::log(high)));
    }
    double sign() { return between(-1, 1) < 0 ? -1 : 1; }
    /// Each component evenly between -size and size.
    Eigen::Vector3d vector(double size) {
        const double x = between(-1, 1);
        const double y = between(-1, 1);
        const double z = between(-1, 1);
        return size * Eigen::Vector3d(x, y, z);
    }

  private:
    std::mt19937 engine_;
};

}  // namespace drillstrand::test
