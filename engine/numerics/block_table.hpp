/// Aligned, padded storage for the step loop.
///
/// Kernels run over whole blocks of block_size entries, a trip count known at compile time: the
/// compiler needs no remainder loop, and the result of an entry does not depend on how the blocks
/// are shared among threads.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <vector>

namespace drillstrand {

inline constexpr std::size_t block_size = 16;       ///< entries: two AVX-512 vectors
inline constexpr std::size_t block_alignment = 64;  ///< bytes: one cache line

/// Blocks that hold `count` entries.
constexpr std::size_t blocks_for(std::size_t count) {
    return (count + block_size - 1) / block_size;
}

/// Neighbouring blocks, `begin` to the one before `end`, that a kernel takes in one go: what is
/// done once per call costs less per entry, and where an entry waits for a root or a quotient the
/// processor works on others.
struct BlockSpan {
    std::size_t begin, end;
    [[nodiscard]] std::size_t entries() const { return (end - begin) * block_size; }
};
inline constexpr std::size_t most_blocks_at_once = 4;  ///< in the first-level cache

/// Spans that hold so many blocks: equally many each but for one, and an even number of spans where
/// there are several blocks, so that two threads share them evenly. They depend on nothing else:
/// with them, no result depends on the number of threads.
std::vector<BlockSpan> equal_spans(std::size_t blocks);

/// Rows of doubles in one allocation, all of the same length. Each row has a block of padding
/// before and after, so that neighbours of the first and last entry can be read. Rows are an odd
/// number of cache lines apart, so that a loop over many rows does not crowd one cache set.
class BlockTable {
  public:
    BlockTable() = default;

    /// `rows` rows that hold `count` entries (rounded up to whole blocks), all of them zero.
    BlockTable(std::size_t rows, std::size_t count);

    BlockTable(const BlockTable& other);
    BlockTable& operator=(const BlockTable& other);
    BlockTable(BlockTable&&) noexcept = default;
    BlockTable& operator=(BlockTable&&) noexcept = default;
    ~BlockTable() = default;

    [[nodiscard]] std::size_t rows() const { return rows_; }
    [[nodiscard]] std::size_t blocks() const { return blocks_; }

    /// Entry 0 of a row, at a multiple of block_alignment; indices -block_size ..
    /// (blocks() + 1) * block_size - 1 exist.
    [[nodiscard]] double* row(std::size_t i) {
        return std::assume_aligned<block_alignment>(storage_.get() + i * stride() + block_size);
    }
    [[nodiscard]] const double* row(std::size_t i) const {
        return std::assume_aligned<block_alignment>(storage_.get() + i * stride() + block_size);
    }

    /// Sets every entry of a row, padding included.
    void fill(std::size_t row, double value);

  private:
    struct Free {
        void operator()(double* p) const {
            ::operator delete[](p, std::align_val_t{block_alignment});
        }
    };
    using Storage = std::unique_ptr<double[], Free>;
    static Storage allocate(std::size_t size);

    [[nodiscard]] std::size_t stride() const {
        return (blocks_ + 2) * block_size + block_alignment / sizeof(double);
    }

    std::size_t rows_ = 0;
    std::size_t blocks_ = 0;
    Storage storage_;
};

}  // namespace drillstrand
