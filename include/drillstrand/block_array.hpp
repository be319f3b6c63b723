/// Aligned, padded storage for the step loop: kernels run over whole blocks of block_size entries
/// with a trip count known at compile time, so the compiler needs no remainder loop and the result
/// of an entry does not depend on how blocks are shared among threads.
#pragma once

#include <cstddef>
#include <memory>
#include <new>

namespace drillstrand {

inline constexpr std::size_t block_size = 16;       ///< entries; two AVX-512 or four AVX2 vectors
inline constexpr std::size_t block_alignment = 64;  ///< bytes: one cache line

/// Blocks needed for `count` entries.
constexpr std::size_t blocks_for(std::size_t count) {
    return (count + block_size - 1) / block_size;
}

/// Doubles at indices -block_size .. blocks * block_size + block_size - 1: one block of padding
/// before and after, so that neighbours of the first and the last entry can be read and written.
class BlockArray {
  public:
    BlockArray() = default;
    explicit BlockArray(std::size_t count, double value = 0.0);
    BlockArray(const BlockArray& other);
    BlockArray& operator=(const BlockArray& other);
    BlockArray(BlockArray&&) noexcept = default;
    BlockArray& operator=(BlockArray&&) noexcept = default;
    ~BlockArray() = default;

    [[nodiscard]] std::size_t blocks() const { return blocks_; }
    [[nodiscard]] bool empty() const { return !storage_; }
    [[nodiscard]] double* data() { return storage_.get() + block_size; }
    [[nodiscard]] const double* data() const { return storage_.get() + block_size; }
    double& operator[](std::ptrdiff_t k) { return data()[k]; }
    double operator[](std::ptrdiff_t k) const { return data()[k]; }
    void fill(double value);

  private:
    struct Free {
        void operator()(double* p) const {
            ::operator delete[](p, std::align_val_t{block_alignment});
        }
    };
    [[nodiscard]] std::size_t allocated() const { return (blocks_ + 2) * block_size; }

    std::size_t blocks_ = 0;
    std::unique_ptr<double[], Free> storage_;
};

}  // namespace drillstrand
