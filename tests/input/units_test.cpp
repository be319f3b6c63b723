/// Units convert by their definitions: inch, pound and gallon are exact in SI, the pound of force
/// is the pound under standard gravity (NIST Special Publication 811, appendix B).
#include "drillstrand/units.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace drillstrand {
namespace {

constexpr double pi = std::numbers::pi;

struct Conversion {
    const char* text;
    Dimension dimension;
    double expected;
};

void expect_conversions(const std::vector<Conversion>& conversions) {
    for (const Conversion& conversion : conversions) {
        SCOPED_TRACE(conversion.text);
        // Equal but for the rounding of a few products.
        EXPECT_DOUBLE_EQ(parse_quantity(conversion.text, conversion.dimension),
                         conversion.expected);
    }
}

TEST(Units, LengthsAndTimes) {
    expect_conversions({{"2 m", dimension::length, 2},
                        {"2mm", dimension::length, 2e-3},
                        {"2 cm", dimension::length, 2e-2},
                        {"2 km", dimension::length, 2000},
                        {"5 in", dimension::length, 0.127},
                        {"30 ft", dimension::length, 9.144},
                        {"9 5/8 in", dimension::length, 9.625 * 0.0254},
                        {"9-5/8 in", dimension::length, 9.625 * 0.0254},
                        {"5/8 in", dimension::length, 0.625 * 0.0254},
                        {"-1.5e2 m", dimension::length, -150},
                        {"+.5 m", dimension::length, 0.5},
                        {"90 s", dimension::time, 90},
                        {"2 ms", dimension::time, 2e-3},
                        {"1.5 min", dimension::time, 90},
                        {"2 h", dimension::time, 7200}});
}

TEST(Units, ForcesAndMoments) {
    expect_conversions({{"65 kN", dimension::force, 65e3},
                        {"1 MN", dimension::force, 1e6},
                        {"3 daN", dimension::force, 30},
                        {"3 kdaN", dimension::force, 30e3},
                        {"1 lbf", dimension::force, 4.4482216152605},
                        {"20 klbf", dimension::force, 88964.43230521},
                        {"20 kip", dimension::force, 88964.43230521},
                        {"1 tonf", dimension::force, 8896.443230521},
                        {"1 tf", dimension::force, 9806.65},
                        {"1 kgf", dimension::force, 9.80665},
                        {"10 N m", dimension::moment, 10},
                        {"10 kN m", dimension::moment, 10e3},
                        {"10 kN*m", dimension::moment, 10e3},
                        {"10 kN·m", dimension::moment, 10e3},
                        {"1 ft lbf", dimension::moment, 1.3558179483314004},
                        {"1 ft-lbf", dimension::moment, 1.3558179483314004},
                        {"1 kJ", dimension::moment, 1000}});
}

TEST(Units, PressuresAndViscosities) {
    expect_conversions({{"1 kPa", dimension::pressure, 1e3},
                        {"1 MPa", dimension::pressure, 1e6},
                        {"206 GPa", dimension::pressure, 206e9},
                        {"1 bar", dimension::pressure, 1e5},
                        {"1 psi", dimension::pressure, 4.4482216152605 / (0.0254 * 0.0254)},
                        {"1 ksi", dimension::pressure, 4448.2216152605 / (0.0254 * 0.0254)},
                        {"1 N/m2", dimension::pressure, 1},
                        {"1 Pa s", dimension::viscosity, 1},
                        {"1 cP", dimension::viscosity, 1e-3},
                        {"1 mPa s", dimension::viscosity, 1e-3},
                        {"1 P", dimension::viscosity, 0.1}});
}

TEST(Units, Densities) {
    expect_conversions({{"1 kg/m3", dimension::density, 1},
                        {"1 kg/m^3", dimension::density, 1},
                        {"1 kg m^-3", dimension::density, 1},
                        {"1 kg m-3", dimension::density, 1},
                        {"1 sg", dimension::density, 1000},
                        {"1 g/cm3", dimension::density, 1000},
                        {"10 ppg", dimension::density, 4.5359237 / 0.003785411784},
                        {"10 lb/gal", dimension::density, 4.5359237 / 0.003785411784},
                        {"1 lb/ft3", dimension::density, 0.45359237 / (0.3048 * 0.3048 * 0.3048)},
                        {"1 kg/m", dimension::linear_density, 1},
                        {"19.5 lb/ft", dimension::linear_density, 19.5 * 0.45359237 / 0.3048}});
}

TEST(Units, AnglesRatesAndCurvatures) {
    expect_conversions({{"180 deg", dimension::angle, pi},
                        {"1 rad", dimension::angle, 1},
                        {"60 rpm", dimension::frequency, 2 * pi},
                        {"1 Hz", dimension::frequency, 2 * pi},
                        {"1 kHz", dimension::frequency, 2000 * pi},
                        {"3 rad/s", dimension::frequency, 3},
                        {"180 deg/s", dimension::frequency, pi},
                        {"3 deg/30m", dimension::curvature, pi / 60 / 30},
                        {"3 deg/30 m", dimension::curvature, pi / 60 / 30},
                        {"3 deg/100ft", dimension::curvature, pi / 60 / 30.48},
                        {"2 1/m", dimension::curvature, 2},
                        {"2 rad/m", dimension::curvature, 2}});
}

TEST(Units, SectionPropertiesAndAccelerations) {
    expect_conversions({{"9.81 m/s2", dimension::acceleration, 9.81},
                        {"9.81 m/s/s", dimension::acceleration, 9.81},
                        {"32 ft/s^2", dimension::acceleration, 32 * 0.3048},
                        {"7 kN m2", dimension::bending_stiffness, 7000},
                        {"7 N m^2", dimension::bending_stiffness, 7},
                        {"7 kg m", dimension::inertia_per_length, 7},
                        {"7 kg m2/m", dimension::inertia_per_length, 7}});
}

TEST(Units, FactorsOfHeadersNeedNoNumber) {
    EXPECT_EQ(unit_factor("ft", dimension::length), 0.3048);
    EXPECT_EQ(unit_factor(" m ", dimension::length), 1);
    EXPECT_EQ(unit_factor("deg", dimension::angle), 2 * pi / 360);
}

std::string message(const char* text, const Dimension& expected) {
    try {
        parse_quantity(text, expected);
        return "";
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
}

TEST(Units, MistakesNameTheCure) {
    EXPECT_EQ(message("5 kN", dimension::length),
              "kN is a force; expected a length such as m, mm, in, ft");
    EXPECT_EQ(message("5 kn", dimension::force), R"(unknown unit "kn"; did you mean "kN"?)");
    EXPECT_EQ(message("5 klbs", dimension::force), R"(unknown unit "klbs"; did you mean "klbf"?)");
    EXPECT_EQ(message("5", dimension::force),
              R"("5" has no unit; expected a force such as N, kN, lbf, klbf, or a number without )"
              "quotes in SI");
    EXPECT_EQ(message("inf N", dimension::force),
              R"("inf N" is not a finite number; expected a finite one)");
    EXPECT_EQ(message("5 30 m", dimension::length),
              R"(unit "30 m" starts with a number; expected a length such as m, mm, in, ft)");
    EXPECT_EQ(message("5 m^", dimension::length),
              R"(unit "m^" has no exponent after ^; expected a length such as m, mm, in, ft)");
    EXPECT_EQ(message("5 m^1.5", dimension::length),
              R"(exponent in unit "m^1.5" is not a single digit; expected a length such as m, mm, )"
              "in, ft");
    EXPECT_EQ(message("5 deg/0m", dimension::curvature),
              R"(number in unit "deg/0m" is not positive and finite; expected a curvature such as )"
              "1/m, deg/30m, deg/100ft");
    EXPECT_EQ(message("5000 lb", dimension::force),
              "lb is a mass; expected a force such as N, kN, lbf, klbf (a pound of force is lbf, a "
              "kilogram of force kgf)");
    EXPECT_EQ(message("5 N3", dimension::force),
              "N3 is a quantity in kg^3 m^3 s^-6; expected a force such as N, kN, lbf, klbf");
}

}  // namespace
}  // namespace drillstrand
