#include "numerics/block_table.hpp"

#include <algorithm>

namespace drillstrand {

BlockTable::BlockTable(std::size_t rows, std::size_t count)
    : rows_(rows), blocks_(blocks_for(count)) {
    const std::size_t size = rows_ * stride();
    storage_.reset(static_cast<double*>(
        ::operator new[](size * sizeof(double), std::align_val_t{block_alignment})));
    std::fill_n(storage_.get(), size, 0.0);
}

void BlockTable::fill(std::size_t i, double value) {
    std::fill_n(row(i) - block_size, (blocks_ + 2) * block_size, value);
}

}  // namespace drillstrand
