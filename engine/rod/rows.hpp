/// Vector quantities in the rows of a block table, for kernels.
#pragma once

#include <cstddef>

#include "forces/well_frame.hpp"
#include "numerics/block_table.hpp"
#include "numerics/kernel.hpp"

namespace drillstrand {

/// Three rows to write, from one entry on.
struct Rows {
    double *x, *y, *z;
    DRILLSTRAND_INLINE void set(std::size_t k, const Triple& v) const {
        x[k] = v.x;
        y[k] = v.y;
        z[k] = v.z;
    }
};

/// Three rows to read, from one entry on.
struct ConstRows {
    const double *x, *y, *z;
    DRILLSTRAND_INLINE Triple operator[](std::size_t k) const { return {x[k], y[k], z[k]}; }
};

inline Rows rows_at(BlockTable& table, std::size_t row, std::ptrdiff_t entry) {
    return {table.row(row) + entry, table.row(row + 1) + entry, table.row(row + 2) + entry};
}

inline ConstRows rows_at(const BlockTable& table, std::size_t row, std::ptrdiff_t entry) {
    return {table.row(row) + entry, table.row(row + 1) + entry, table.row(row + 2) + entry};
}

}  // namespace drillstrand
