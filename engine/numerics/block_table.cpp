#include "numerics/block_table.hpp"

#include <algorithm>

namespace drillstrand {

BlockTable::BlockTable(std::size_t rows, std::size_t count)
    : rows_(rows), blocks_(blocks_for(count)), storage_(allocate(rows_ * stride())) {
    std::fill_n(storage_.get(), rows_ * stride(), 0.0);
}

BlockTable::BlockTable(const BlockTable& other)
    : rows_(other.rows_), blocks_(other.blocks_), storage_(allocate(rows_ * stride())) {
    std::copy_n(other.storage_.get(), rows_ * stride(), storage_.get());
}

BlockTable& BlockTable::operator=(const BlockTable& other) {
    if (this != &other) *this = BlockTable(other);
    return *this;
}

BlockTable::Storage BlockTable::allocate(std::size_t size) {
    return Storage(static_cast<double*>(
        ::operator new[](size * sizeof(double), std::align_val_t{block_alignment})));
}

void BlockTable::fill(std::size_t i, double value) {
    std::fill_n(row(i) - block_size, (blocks_ + 2) * block_size, value);
}

std::vector<BlockSpan> equal_spans(std::size_t blocks) {
    const std::size_t pairs = (blocks + 2 * most_blocks_at_once - 1) / (2 * most_blocks_at_once);
    const std::size_t count = std::min(blocks, 2 * pairs);
    std::vector<BlockSpan> spans;
    for (std::size_t i = 0; i < count; ++i)
        spans.push_back({blocks * i / count, blocks * (i + 1) / count});
    return spans;
}

}  // namespace drillstrand
