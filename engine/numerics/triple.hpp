/// Vectors in space, for kernels.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <type_traits>

#include "numerics/kernel.hpp"

namespace drillstrand {

template <class Real>
struct TripleOf {
    Real x, y, z;
};
using Triple = TripleOf<double>;

template <class Real>
DRILLSTRAND_INLINE Real dot(const TripleOf<Real>& a, const TripleOf<Real>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class Real>
DRILLSTRAND_INLINE TripleOf<Real> cross(const TripleOf<Real>& a, const TripleOf<Real>& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class Real>
DRILLSTRAND_INLINE TripleOf<Real> combine(std::type_identity_t<Real> a, const TripleOf<Real>& u,
                                          std::type_identity_t<Real> b, const TripleOf<Real>& v) {
    return {a * u.x + b * v.x, a * u.y + b * v.y, a * u.z + b * v.z};
}

template <class Real>
DRILLSTRAND_INLINE TripleOf<Real> scaled(std::type_identity_t<Real> a, const TripleOf<Real>& v) {
    return {a * v.x, a * v.y, a * v.z};
}

/// v/|v| of a vector whose length is 1 but for rounding.
DRILLSTRAND_INLINE Triple of_unit_length(const Triple& v) {
    return scaled(1.5 - 0.5 * dot(v, v), v);
}

inline Triple triple(const Eigen::Vector3d& v) {
    return {v.x(), v.y(), v.z()};
}
inline Eigen::Vector3d vector(const Triple& v) {
    return {v.x, v.y, v.z};
}

/// Three rows to write, from one entry on.
struct Triples {
    double *x, *y, *z;
    DRILLSTRAND_INLINE void set(std::size_t k, const Triple& v) const {
        x[k] = v.x;
        y[k] = v.y;
        z[k] = v.z;
    }
};

DRILLSTRAND_INLINE Triple at(const Triples& rows, std::size_t k) {
    return {rows.x[k], rows.y[k], rows.z[k]};
}

/// Three rows to read, from one entry on.
struct ConstTriples {
    const double *x, *y, *z;
    DRILLSTRAND_INLINE Triple operator[](std::size_t k) const { return {x[k], y[k], z[k]}; }
};

}  // namespace drillstrand
