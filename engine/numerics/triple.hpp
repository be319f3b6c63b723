/// Vectors in space, for kernels.
#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "numerics/kernel.hpp"

namespace drillstrand {

struct Triple {
    double x, y, z;
};

DRILLSTRAND_INLINE double dot(const Triple& a, const Triple& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

DRILLSTRAND_INLINE Triple cross(const Triple& a, const Triple& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

DRILLSTRAND_INLINE Triple combine(double a, const Triple& u, double b, const Triple& v) {
    return {a * u.x + b * v.x, a * u.y + b * v.y, a * u.z + b * v.z};
}

DRILLSTRAND_INLINE Triple scaled(double a, const Triple& v) {
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

/// Three rows to read, from one entry on.
struct ConstTriples {
    const double *x, *y, *z;
    DRILLSTRAND_INLINE Triple operator[](std::size_t k) const { return {x[k], y[k], z[k]}; }
};

}  // namespace drillstrand
