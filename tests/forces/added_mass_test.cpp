// Added mass of a pipe off the axis of its hole, against potential flow.
#include "forces/added_mass.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/annular_flow.hpp"
#include "support/dice.hpp"

namespace drillstrand {
namespace {

using test::Annulus;
using test::Dice;

double relative(double value, double reference) {
    return std::abs(value / reference - 1);
}

AddedMass mass_in(const Annulus& annulus) {
    return added_mass({annulus.eccentricity, annulus.pipe, annulus.hole});
}

/// Pipes of a twentieth of their hole to ones that leave a fiftieth, off the axis by up to 0.99 of
/// the clearance.
template <class Check>
void for_random_annuli(Check check) {
    Dice dice(31);
    for (int i = 0; i < 5000; ++i) {
        const double hole = dice.decades(0.05, 0.5);
        const double pipe = hole * dice.between(0.05, 0.98);
        check(Annulus{pipe, hole, (hole - pipe) * dice.between(1e-3, 0.99)});
    }
}

struct Published {
    double pipe, hole, part, coefficient;
};

// the series of potential flow in bipolar coordinates, summed with 30 digits
constexpr Published potential_flow[] = {{0.07, 0.11, 0, 2.361111},
                                        {0.07, 0.11, 0.5, 2.572263244},
                                        {0.07, 0.11, 0.75, 2.975153227},
                                        {0.07, 0.11, 0.9, 3.576929},
                                        {0.12225, 0.1556, 0, 4.225682},
                                        {0.12225, 0.1556, 0.5, 4.586600666},
                                        {0.12225, 0.1556, 0.75, 5.257196652},
                                        {0.12225, 0.1556, 0.9, 6.229609}};

TEST(AddedMass, IsThatOfPotentialFlowAroundThePipesOfWells) {
    for (const Published& p : potential_flow) {
        const double found = added_mass({p.part * (p.hole - p.pipe), p.pipe, p.hole}).coefficient;
        // the figures that the table has
        EXPECT_NEAR(found, p.coefficient, 6e-7) << p.pipe << " at " << p.part;
    }
}

TEST(AddedMass, IsTheSeriesInBipolarCoordinatesInAnyAnnulus) {
    for_random_annuli([](const Annulus& annulus) {
        EXPECT_LT(relative(mass_in(annulus).coefficient, test::potential_flow_mass(annulus)), 1e-9)
            << annulus.pipe / annulus.hole << " at " << annulus.eccentricity / annulus.clearance();
    });
}

TEST(AddedMass, OnTheAxisIsThatOfStokes) {
    Dice dice(32);
    for (int i = 0; i < 1000; ++i) {
        const double hole = dice.decades(0.05, 0.5);
        const double pipe = hole * dice.between(0.01, 0.99);
        const AddedMass added = added_mass({0, pipe, hole});
        EXPECT_LT(
            relative(added.coefficient, (hole * hole + pipe * pipe) / (hole * hole - pipe * pipe)),
            1e-9);
        EXPECT_EQ(added.slope, 0);
    }
}

TEST(AddedMass, InAWideHoleIsThatOfTheOpenSea) {
    EXPECT_LT(relative(added_mass({0.1, 1e-3, 100}).coefficient, 1), 1e-9);
}

TEST(AddedMass, OfAThinPipeAtTheWallIsThatOfACylinderOnAPlane) {
    const double plane = std::numbers::pi * std::numbers::pi / 3 - 1;
    const double clearance = 1 - 1e-5;
    // the slope is not finite there: root of the film
    EXPECT_NEAR(added_mass({(1 - 1e-12) * clearance, 1e-5, 1}).coefficient, plane, 1e-3 * plane);
}

TEST(AddedMass, SlopeIsThatOfTheSeries) {
    for_random_annuli([](const Annulus& annulus) {
        const AddedMass added = mass_in(annulus);
        // terms of opposite sign: to 1e-9 of the mass over the clearance besides
        EXPECT_NEAR(added.slope, test::potential_flow_slope(annulus),
                    1e-8 * added.slope + 1e-9 * added.coefficient / annulus.clearance())
            << annulus.pipe / annulus.hole << " at " << annulus.eccentricity / annulus.clearance();
        EXPECT_GT(added.slope, 0);
    });
}

TEST(AddedMass, SlopeIsTheLimitOfDifferenceQuotients) {
    for_random_annuli([](const Annulus& annulus) {
        const double step = 1e-4 * (annulus.clearance() - annulus.eccentricity);
        const auto beside = [&](double way) {
            return added_mass({annulus.eccentricity + way, annulus.pipe, annulus.hole}).coefficient;
        };
        const double quotient =
            (8 * (beside(step) - beside(-step)) - (beside(2 * step) - beside(-2 * step))) /
            (12 * step);
        EXPECT_NEAR(mass_in(annulus).slope, quotient, 1e-6 * quotient + 1e-12 * beside(0) / step);
    });
}

}  // namespace
}  // namespace drillstrand
