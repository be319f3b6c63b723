// A program outside the project: it sees the public headers only, one function from the headers
// and one from the library.
#include <cmath>
#include <cstdio>

#include "drillstrand/schedule.hpp"
#include "drillstrand/units.hpp"

int main() {
    const double weight = drillstrand::parse_quantity("65 kN", drillstrand::dimension::force);
    const drillstrand::Schedule<double> on_bit({45.0, 50.0}, {0.0, weight});
    const double half_way = on_bit(47.5);
    std::printf("weight on bit half way: %g N\n", half_way);
    return std::abs(half_way - 32500.0) < 1e-9 ? 0 : 1;
}
