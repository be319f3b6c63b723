/// Exact vibrations of Timoshenko's beam under tension, of several spans with springs between them:
/// the equations of each span integrated by a matrix exponential, from a clamped or pinned head to
/// a free end.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <unsupported/Eigen/MatrixFunctions>
#include <utility>
#include <vector>

namespace drillstrand::test {

/// Uniform part of a beam, and the spring across it at its end.
struct BeamSpan {
    double length;
    double mass;           ///< that moves sideways (kg/m)
    double inertia;        ///< rho I (kg m)
    double polar_inertia;  ///< rho Ip (kg m)
    double bending;        ///< EI (N m2)
    double shear;          ///< kGA (N)
    double tension = 0;    ///< N
    double spring = 0;     ///< N/m
};

enum class BeamHead { clamped, pinned };

/// A beam in circular motion exp(i w t) while it turns about its axis at a rate W, positive in the
/// same sense: w' = (V + kGA q)/(kGA + T), EI q' = M, M' = - kGA (w' - q) - (J w^2 - Jp W w) q,
/// V' = - m w^2 w.
class ExactBeam {
  public:
    ExactBeam(BeamHead head, std::vector<BeamSpan> spans) : head_(head), spans_(std::move(spans)) {}

    /// The first `count` frequencies (rad/s) above `start`, of a beam that turns at the rate
    /// turning(w).
    template <class Turning>
    [[nodiscard]] std::vector<double> frequencies(std::size_t count, double step,
                                                  const Turning& turning) const {
        std::vector<double> found;
        const auto residual = [&](double w) { return determinant(w, turning(w)); };
        for (double w = 1e-6 * step; found.size() < count; w += step) {
            double low = w;
            double high = w + step;
            const double sign = residual(low);
            if (sign * residual(high) > 0) continue;
            for (int i = 0; i < 60; ++i) {
                const double middle = 0.5 * (low + high);
                (sign * residual(middle) > 0 ? low : high) = middle;
            }
            found.push_back(0.5 * (low + high));
        }
        return found;
    }
    [[nodiscard]] std::vector<double> frequencies(std::size_t count, double step) const {
        return frequencies(count, step, [](double) { return 0.0; });
    }

  private:
    /// Zero where a motion leaves neither moment nor force at the free end.
    [[nodiscard]] double determinant(double w, double rate) const {
        Eigen::Matrix<double, 4, 2> y = Eigen::Matrix<double, 4, 2>::Zero();
        y(head_ == BeamHead::clamped ? 2 : 1, 0) = 1;
        y(3, 1) = 1;
        for (const BeamSpan& span : spans_) {
            const Eigen::Matrix4d exponent = span.length * slope(span, w, rate);
            y = exponent.exp() * y;
            y.row(3) += span.spring * y.row(0);
            y /= y.norm();
        }
        return y(2, 0) * y(3, 1) - y(2, 1) * y(3, 0);
    }

    static Eigen::Matrix4d slope(const BeamSpan& s, double w, double rate) {
        Eigen::Matrix4d a = Eigen::Matrix4d::Zero();
        const double softness = 1 / (s.shear + s.tension);
        a(0, 1) = s.shear * softness;
        a(0, 3) = softness;
        a(1, 2) = 1 / s.bending;
        a(2, 1) = s.shear * (1 - a(0, 1)) - (s.inertia * w * w - s.polar_inertia * rate * w);
        a(2, 3) = -s.shear * softness;
        a(3, 0) = -s.mass * w * w;
        return a;
    }

    BeamHead head_;
    std::vector<BeamSpan> spans_;
};

}  // namespace drillstrand::test
