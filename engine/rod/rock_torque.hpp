/// The torque of rock on a bit that drills, about the axis of the bit.
#pragma once

namespace drillstrand {

struct RockTorque {
    double steady = 0;  ///< against a positive rotation, whether the bit turns or not (N m)
    double on = 0;      ///< the most against turning on (N m)
    double back = 0;    ///< the most against turning back (N m)

    /// The spin that it leaves of a free one in a step of `mobility` = time over inertia.
    [[nodiscard]] double spin_left(double free, double mobility) const {
        const double without = free - mobility * steady;
        if (without > mobility * on) return without - mobility * on;
        const double backward = without + mobility * back;
        return backward < 0 ? backward : 0;
    }
};

}  // namespace drillstrand
