// Threads write their own part of one array, then read the other threads' part of it: a race
// unless a barrier lies between. BARRIER says whether it does.
#include <cstddef>
#include <cstdio>
#include <vector>

namespace {

constexpr std::ptrdiff_t size = 1000;

void shift_by_half(const std::vector<double>& from, std::vector<double>& to) {
    const double* const source = from.data();
    double* const target = to.data();
#pragma omp for schedule(static) nowait
    for (std::ptrdiff_t i = 0; i < size; ++i) {
        target[i] = source[(i + size / 2) % size] + 1.0;
    }
    if constexpr (BARRIER) {
#pragma omp barrier
    }
}

}  // namespace

int main() {
    std::vector<double> a(size), b(size);
#pragma omp parallel num_threads(4)
    for (int step = 0; step < 50; ++step) {
        shift_by_half(a, b);
        shift_by_half(b, a);
    }
    std::printf("%g\n", a[0]);
    return 0;
}
