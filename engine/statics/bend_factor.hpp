/// f = b / sin b, by which the angle between two directors exceeds their cross product.
#pragma once

#include <cmath>

namespace drillstrand {

/// f of the cosine of b, and its derivatives by that cosine; unlike the rod's own
/// (model/segment_strain.hpp), for any angle, since iterates may bend by more than they will.
template <class Scalar>
struct BendFactor {
    Scalar f, slope, curve;
};

template <class Scalar>
BendFactor<Scalar> bend_factor(const Scalar& cosine, const Scalar& sine2) {
    using std::atan2;
    using std::sqrt;
    if (sine2 < 1e-4 && cosine > 0) {
        // series in s = sin b: f = asin(s) / s, d/dc = -(c / s) d/ds
        const Scalar u = 1.0 / 3 + sine2 * (3.0 / 10 + sine2 * (15.0 / 56 + sine2 * (35.0 / 144)));
        const Scalar du = 3.0 / 5 + sine2 * (15.0 / 14 + sine2 * (35.0 / 24));
        const Scalar f = 1 + sine2 * (1.0 / 6 + sine2 * (3.0 / 40 + sine2 * (5.0 / 112)));
        return {f, -cosine * u, -u + cosine * cosine * du};
    }
    const Scalar sine = sqrt(sine2);
    const Scalar f = atan2(sine, cosine) / sine;
    const Scalar slope = (f * cosine - 1) / sine2;
    return {f, slope, (f + 3 * cosine * slope) / sine2};
}

}  // namespace drillstrand
