#include "input/dimension_names.hpp"

#include <fmt/format.h>

#include <array>
#include <string_view>

namespace drillstrand {

namespace {

struct Name {
    Dimension dimension;
    std::string_view noun;
    std::string_view si;
    std::string_view examples;
};

constexpr std::array names{
    Name{dimension::angle, "an angle", "rad", "deg, rad"},
    Name{dimension::length, "a length", "m", "m, mm, in, ft"},
    Name{dimension::time, "a time", "s", "s, min, h"},
    Name{dimension::frequency, "a frequency", "rad/s", "rpm, Hz, rad/s"},
    Name{dimension::acceleration, "an acceleration", "m/s2", "m/s2, ft/s2"},
    Name{dimension::force, "a force", "N", "N, kN, lbf, klbf"},
    Name{dimension::moment, "a moment", "N m", "N m, kN m, ft lbf"},
    Name{dimension::pressure, "a pressure", "Pa", "Pa, MPa, GPa, psi"},
    Name{dimension::viscosity, "a viscosity", "Pa s", "Pa s, mPa s, cP"},
    Name{dimension::density, "a density", "kg/m3", "kg/m3, ppg, sg, lb/ft3"},
    Name{dimension::linear_density, "a mass per length", "kg/m", "kg/m, lb/ft"},
    Name{dimension::curvature, "a curvature", "1/m", "1/m, deg/30m, deg/100ft"},
    Name{dimension::bending_stiffness, "a bending stiffness", "N m2", "N m2, kN m2, lbf ft2"},
    Name{dimension::inertia_per_length, "an inertia per length", "kg m", "kg m, lb ft"},
    Name{{1, 0, 0}, "a mass", "kg", "kg, lb"},
    Name{dimension::area, "an area", "m2", "m2, in2"},
    Name{{0, 3, 0}, "a volume", "m3", "m3, L"},
    Name{dimension::flow_rate, "a flow rate", "m3/s", "m3/s, L/min, gpm"},
    Name{dimension::speed, "a speed", "m/s", "m/s, ft/h"},
    Name{{1, 0, -1}, "a damping", "N s/m", "N s/m, kg/s"},
    Name{{1, 1, -1}, "a damping of rotation per length", "N s", "N s, kg m/s"},
    Name{{1, 2, -1}, "a damping of rates of bending and twist", "N m s", "N m s, kg m2/s"},
    Name{{1, 2, 0}, "a moment of inertia", "kg m2", "kg m2, lb ft2"},
    Name{dimension::power, "a power", "W", "W, kW, hp"},
    Name{{1, 0, -2}, "a force per length", "N/m", "N/m, lbf/ft"},
    Name{{-1, 0, 1}, "a speed over a force", "s/kg", "s/kg, m/s/N"},
    Name{{-1, -1, 1}, "a speed over a moment", "s/(kg m)", "s/kg/m, m/s/N/m"},
    Name{{-1, 2, 1}, "a speed over a pressure", "m2 s/kg", "m2 s/kg, m/s/Pa"},
    Name{{0, -1, 1}, "a time over a length", "s/m", "s/m, s/ft"},
};

const Name* find(const Dimension& dimension) {
    for (const Name& name : names) {
        if (name.dimension == dimension) return &name;
    }
    return nullptr;
}

std::string powers(const Dimension& dimension) {
    return fmt::format("kg^{} m^{} s^{}", dimension.mass, dimension.length, dimension.time);
}

}  // namespace

std::string dimension_noun(const Dimension& dimension) {
    const Name* name = find(dimension);
    return name ? std::string(name->noun) : fmt::format("a quantity in {}", powers(dimension));
}

std::string si_unit(const Dimension& dimension) {
    const Name* name = find(dimension);
    return name ? std::string(name->si) : powers(dimension);
}

std::string describe_dimension(const Dimension& dimension) {
    const Name* name = find(dimension);
    if (!name) return dimension_noun(dimension);
    return fmt::format("{} such as {}", name->noun, name->examples);
}

}  // namespace drillstrand
