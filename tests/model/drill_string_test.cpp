#include "drillstrand/drill_string.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

namespace drillstrand {
namespace {

constexpr double pi = std::numbers::pi;

Component steel_pipe(double length, double outer, double inner) {
    Component pipe;
    pipe.length = length;
    pipe.outer_diameter = outer;
    pipe.inner_diameter = inner;
    pipe.linear_density = 7850 * pi / 4 * (outer * outer - inner * inner);
    pipe.youngs_modulus = 2.06e11;
    return pipe;
}

/// Up to 30 components from 0.2 m to 300 m long.
StringCase random_string(std::mt19937& random) {
    std::uniform_int_distribution<int> count(1, 30);
    std::uniform_real_distribution<double> log_length(std::log(0.2), std::log(300));
    std::uniform_real_distribution<double> outer(0.1, 0.25);
    std::uniform_real_distribution<double> bore(0.3, 0.9);
    std::uniform_real_distribution<double> bend(-1e-3, 1e-3);
    StringCase string;
    const int n = count(random);
    for (int k = 0; k < n; ++k) {
        const double diameter = outer(random);
        string.components.push_back(
            steel_pipe(std::exp(log_length(random)), diameter, bore(random) * diameter));
        string.components.back().curvature = {bend(random), bend(random), bend(random)};
    }
    return string;
}

/// `zero` plus the sum over the components of their length times a property.
template <typename Value, typename Property>
Value integral_over_components(const StringCase& string, Value zero, Property property) {
    for (const Component& component : string.components)
        zero +=
            component.length * property(section_properties(component, string.shear_coefficient));
    return zero;
}

TEST(SectionProperties, OfThePaperCantileverAreThePipeFormulas) {
    Component pipe = steel_pipe(24, 0.1397, 0.1155);
    pipe.youngs_modulus = 200e9;
    pipe.poisson_ratio = 0;
    pipe.linear_density = 34.2277;
    const SectionProperties section = section_properties(pipe, 1.0);
    EXPECT_NEAR(section.axial_stiffness, 970098678.7, 0.1);
    EXPECT_NEAR(section.shear_stiffness, 485049339.3, 0.1);
    EXPECT_NEAR(section.bending_stiffness, 1992118.251, 1e-3);
    EXPECT_NEAR(section.torsional_stiffness, 1992118.251, 1e-3);
    EXPECT_NEAR(section.metal_area, pi / 4 * (0.1397 * 0.1397 - 0.1155 * 0.1155), 1e-17);
    EXPECT_NEAR(section.outer_area, pi / 4 * 0.1397 * 0.1397, 1e-17);
    EXPECT_EQ(section.outer_radius, 0.1397 / 2);
    EXPECT_EQ(section.mass, 34.2277);
    const double second_moment = pi / 64 * (std::pow(0.1397, 4) - std::pow(0.1155, 4));
    EXPECT_NEAR(section.inertia, 34.2277 * second_moment / section.metal_area, 1e-15);
    EXPECT_EQ(section.polar_inertia, 2 * section.inertia);
}

TEST(SectionProperties, PoissonRatioLowersShearAndTorsionOnly) {
    Component pipe = steel_pipe(1, 0.2, 0.1);
    pipe.poisson_ratio = 0;
    const SectionProperties without = section_properties(pipe, 1.0);
    pipe.poisson_ratio = 0.25;
    const SectionProperties with = section_properties(pipe, 0.5);
    EXPECT_DOUBLE_EQ(with.torsional_stiffness, without.torsional_stiffness / 1.25);
    EXPECT_DOUBLE_EQ(with.shear_stiffness, 0.5 * without.shear_stiffness / 1.25);
    EXPECT_EQ(with.bending_stiffness, without.bending_stiffness);
    EXPECT_EQ(with.axial_stiffness, without.axial_stiffness);
}

TEST(SectionProperties, WhatIsGivenOutrightReplacesWhatWasComputed) {
    Component pipe = steel_pipe(1, 0.2, 0.1);
    pipe.bending_stiffness = 1;
    pipe.torsional_stiffness = 2;
    pipe.axial_stiffness = 3;
    pipe.shear_stiffness = 4;
    pipe.inertia = 5;
    SectionProperties section = section_properties(pipe, 0.5);
    EXPECT_EQ(section.bending_stiffness, 1);
    EXPECT_EQ(section.torsional_stiffness, 2);
    EXPECT_EQ(section.axial_stiffness, 3);
    EXPECT_EQ(section.shear_stiffness, 4);
    EXPECT_EQ(section.inertia, 5);
    EXPECT_EQ(section.polar_inertia, 10);
    pipe.polar_inertia = 7;
    EXPECT_EQ(section_properties(pipe, 0.5).polar_inertia, 7);
}

TEST(SectionProperties, NeedNoDiameterWhereEverythingIsGiven) {
    Component rod;
    rod.length = 10;
    rod.linear_density = 1;
    rod.bending_stiffness = rod.torsional_stiffness = 500;
    rod.axial_stiffness = rod.shear_stiffness = 1e4;
    rod.inertia = rod.polar_inertia = 10;
    const SectionProperties section = section_properties(rod, 1.0);
    EXPECT_EQ(section.bending_stiffness, 500);
    EXPECT_EQ(section.inertia, 10);
    EXPECT_EQ(section.metal_area, 0);
}

MeshCase uniform(int segments) {
    MeshCase mesh;
    mesh.segments = segments;
    return mesh;
}

constexpr Lumping every_lumping[] = {Lumping::cells, Lumping::cubic_clamped_head,
                                     Lumping::cubic_free_head};

/// Mass of each node (kg).
std::vector<double> node_masses(const StringMesh& mesh) {
    std::vector<double> mass;
    for (std::size_t k = 0; k < mesh.node.size(); ++k)
        mass.push_back(mesh.cell[k] * mesh.node[k].mass);
    return mass;
}

/// Light pipe of 1 kg/m, heavy of `ratio` kg/m, by lengths (m), in turns.
StringCase light_and_heavy(const std::vector<double>& lengths, double ratio) {
    StringCase string;
    for (const double length : lengths) {
        string.components.push_back(steel_pipe(length, 0.127, 0.1086));
        string.components.back().linear_density = string.components.size() % 2 == 1 ? 1 : ratio;
    }
    return string;
}

TEST(StringMesh, AUniformStringKeepsItsOwnProperties) {
    // Also when it comes as a table of unequal joints of the same pipe.
    StringCase string;
    for (const double length : {9.1, 12.7, 0.3, 100.0, 33.3})
        string.components.push_back(steel_pipe(length, 0.127, 0.1086));
    const SectionProperties pipe = section_properties(string.components[0], 1.0);
    for (const Lumping lumping : every_lumping) {
        const StringMesh mesh = mesh_string(string, uniform(37), lumping);
        std::vector<SectionProperties> sections = mesh.node;
        sections.insert(sections.end(), mesh.segment.begin(), mesh.segment.end());
        for (const SectionProperties& section : sections) {
            EXPECT_EQ(section.mass, pipe.mass);
            EXPECT_EQ(section.inertia, pipe.inertia);
            EXPECT_EQ(section.polar_inertia, pipe.polar_inertia);
            EXPECT_EQ(section.axial_stiffness, pipe.axial_stiffness);
            EXPECT_EQ(section.shear_stiffness, pipe.shear_stiffness);
            EXPECT_EQ(section.bending_stiffness, pipe.bending_stiffness);
            EXPECT_EQ(section.torsional_stiffness, pipe.torsional_stiffness);
            EXPECT_EQ(section.metal_area, pipe.metal_area);
            EXPECT_EQ(section.outer_area, pipe.outer_area);
            EXPECT_EQ(section.outer_radius, pipe.outer_radius);
        }
    }
}

TEST(StringMesh, IsUniformWithHalfCellsAtBothEnds) {
    StringCase string;
    string.components = {steel_pipe(100, 0.127, 0.1086)};
    const StringMesh mesh = mesh_string(string, uniform(8), Lumping::cells);
    ASSERT_EQ(mesh.node_s.size(), 9U);
    ASSERT_EQ(mesh.segment_s.size(), 8U);
    EXPECT_EQ(mesh.node_s.front(), 0);
    EXPECT_EQ(mesh.node_s.back(), 100);
    EXPECT_EQ(mesh.segment_s.front(), 6.25);
    for (const double length : mesh.length)
        EXPECT_DOUBLE_EQ(length, 12.5);
    EXPECT_DOUBLE_EQ(mesh.cell.front(), 6.25);
    EXPECT_DOUBLE_EQ(mesh.cell[4], 12.5);
    EXPECT_DOUBLE_EQ(mesh.cell.back(), 6.25);
}

TEST(StringMesh, CubicsShareTheLoadOfAFreeEndWithItsNeighbour) {
    // Gregory's weights 5/12 and 13/12; a clamp takes the couple of the load beside it.
    const StringCase string = light_and_heavy({96}, 1);
    const auto expect_cells = [&](int segments, Lumping lumping, std::vector<double> twelfths) {
        const StringMesh mesh = mesh_string(string, uniform(segments), lumping);
        const double h = 96.0 / segments;
        ASSERT_EQ(mesh.cell.size(), twelfths.size());
        for (std::size_t k = 0; k < twelfths.size(); ++k)
            EXPECT_DOUBLE_EQ(mesh.cell[k], twelfths[k] / 12 * h) << "node " << k;
    };
    expect_cells(4, Lumping::cubic_clamped_head, {6, 12, 12, 13, 5});
    expect_cells(4, Lumping::cubic_free_head, {5, 13, 12, 13, 5});
    expect_cells(2, Lumping::cubic_free_head, {5, 14, 5});
    expect_cells(1, Lumping::cubic_clamped_head, {7, 5});
    expect_cells(1, Lumping::cubic_free_head, {6, 6});
}

TEST(StringMesh, CubicsMoveTheCoupleOfAJumpBetweenItsNeighbours) {
    // 8 segments of 1 m, three times the mass from node 4 on: a couple of 2/12 there.
    const std::vector<double> mass = node_masses(
        mesh_string(light_and_heavy({4, 4}, 3), uniform(8), Lumping::cubic_clamped_head));
    const double expected[] = {0.5, 1, 1, 1 - 1.0 / 12, 2, 3 + 1.0 / 12, 3, 3.25, 1.25};
    for (std::size_t k = 0; k < mass.size(); ++k)
        EXPECT_NEAR(mass[k], expected[k], 1e-14) << "node " << k;
}

TEST(StringMesh, CubicsKeepTheCentreOfMassOfFreeStrings) {
    const StringCase string = light_and_heavy({3.1, 0.4, 7.7, 5.3, 2.5}, 4);
    double first_moment = 0;
    double start = 0;
    for (const Component& part : string.components) {
        first_moment += part.linear_density * part.length * (start + part.length / 2);
        start += part.length;
    }
    for (const int segments : {1, 2, 3, 7, 40}) {
        const StringMesh mesh = mesh_string(string, uniform(segments), Lumping::cubic_free_head);
        const std::vector<double> mass = node_masses(mesh);
        const double sum = std::inner_product(mass.begin(), mass.end(), mesh.node_s.begin(), 0.0);
        EXPECT_NEAR(sum / first_moment, 1, 1e-13) << segments << " segments";
    }
}

TEST(StringMesh, CubicsConvergeToTheWorkOfALoadAtFourthOrder) {
    // Work of the weight of a string with a joint inside a segment, bent as sin from a free head.
    const double length = 20;
    const double joint = length * 0.3;
    const StringCase string = light_and_heavy({joint, length - joint}, 4);
    const double rate = 2 * pi / length;
    const double exact = ((1 - std::cos(rate * joint)) + 4 * (std::cos(rate * joint) - 1)) / rate;
    const auto error = [&](int segments) {
        const StringMesh mesh = mesh_string(string, uniform(segments), Lumping::cubic_free_head);
        const std::vector<double> mass = node_masses(mesh);
        double work = 0;
        for (std::size_t k = 0; k < mass.size(); ++k)
            work += mass[k] * std::sin(rate * mesh.node_s[k]);
        return std::abs(work - exact);
    };
    EXPECT_LT(error(32), error(16) / 7) << "third order at least, from end to end";
    EXPECT_LT(error(64), 1e-4 * std::abs(exact));
}

TEST(StringMesh, CubicsLeaveEachNodeAQuarterOfItsOwnBesideMuchHeavierPipe) {
    for (const double ratio : {10.0, 30.0, 1e4}) {
        const StringCase string = light_and_heavy({4, 4, 2, 4.5, 0.5, 5}, ratio);
        for (const Lumping lumping : {Lumping::cubic_clamped_head, Lumping::cubic_free_head}) {
            const std::vector<double> mass = node_masses(mesh_string(string, uniform(20), lumping));
            EXPECT_GE(*std::min_element(mass.begin(), mass.end()), 5.0 / 12 / 4) << ratio;
            EXPECT_NEAR(std::accumulate(mass.begin(), mass.end(), 0.0) / (6.5 + 13.5 * ratio), 1,
                        1e-14);
        }
    }
}

TEST(StringMesh, TotalsOfRandomStringsAreKept) {
    std::mt19937 random(1);
    std::uniform_int_distribution<int> segments(1, 400);
    for (int n = 0; n < 100; ++n) {
        const StringCase string = random_string(random);
        const StringMesh mesh =
            mesh_string(string, uniform(segments(random)), every_lumping[n % 3]);
        const auto expect_kept = [&](auto member) {
            double sum = 0;
            for (std::size_t k = 0; k < mesh.node.size(); ++k)
                sum += mesh.cell[k] * (mesh.node[k].*member);
            const double exact = integral_over_components(
                string, 0.0, [&](const SectionProperties& section) { return section.*member; });
            EXPECT_NEAR(sum / exact, 1, 1e-12);
        };
        expect_kept(&SectionProperties::mass);
        expect_kept(&SectionProperties::inertia);
        expect_kept(&SectionProperties::polar_inertia);
        expect_kept(&SectionProperties::metal_area);
        expect_kept(&SectionProperties::outer_area);

        double length = 0;
        for (const double h : mesh.length)
            length += h;
        EXPECT_NEAR(length / total_length(string), 1, 1e-12);
    }
}

TEST(StringMesh, UniformStressStretchesAndTurnsTheMeshAsTheString) {
    std::mt19937 random(2);
    std::uniform_int_distribution<int> segments(1, 400);
    for (int n = 0; n < 100; ++n) {
        const StringCase string = random_string(random);
        const StringMesh mesh = mesh_string(string, uniform(segments(random)), Lumping::cells);
        // Stretch under unit tension, twist under unit torque, turn under unit bending moment.
        for (const auto stiffness :
             {&SectionProperties::axial_stiffness, &SectionProperties::shear_stiffness,
              &SectionProperties::bending_stiffness, &SectionProperties::torsional_stiffness}) {
            double sum = 0;
            for (std::size_t k = 0; k < mesh.segment.size(); ++k)
                sum += mesh.length[k] / (mesh.segment[k].*stiffness);
            const double exact = integral_over_components(
                string, 0.0,
                [&](const SectionProperties& section) { return 1 / (section.*stiffness); });
            EXPECT_NEAR(sum / exact, 1, 1e-12);
        }
        Eigen::Vector3d turn = Eigen::Vector3d::Zero();
        for (std::size_t k = 0; k < mesh.segment.size(); ++k)
            turn += mesh.length[k] * mesh.segment[k].curvature;
        const Eigen::Vector3d exact_turn = integral_over_components(
            string, Eigen::Vector3d(0, 0, 0),
            [](const SectionProperties& section) { return section.curvature; });
        EXPECT_LT((turn - exact_turn).norm(), 1e-12);
    }
}

TEST(StringMesh, HangingStringStretchesUnderABitLoadByTheSumOfItsParts) {
    StringCase string;
    string.components = {steel_pipe(1900, 0.149225, 0.128143), steel_pipe(100, 0.2, 0.07)};
    const StringMesh mesh = mesh_string(string, uniform(33), Lumping::cells);
    const double load = 1e5;
    double stretch = 0;
    for (std::size_t k = 0; k < mesh.segment.size(); ++k)
        stretch += mesh.length[k] * load / mesh.segment[k].axial_stiffness;
    const double area1 = pi / 4 * (0.149225 * 0.149225 - 0.128143 * 0.128143);
    const double area2 = pi / 4 * (0.2 * 0.2 - 0.07 * 0.07);
    EXPECT_NEAR(stretch, load / 2.06e11 * (1900 / area1 + 100 / area2), 1e-12);
}

TEST(StringMesh, NodesCarryTheRadiusOfTheirComponent) {
    StringCase string;
    string.components = {steel_pipe(50, 0.10, 0.05), steel_pipe(49.7, 0.20, 0.05),
                         steel_pipe(0.3, 0.15, 0.05)};
    const StringMesh mesh = mesh_string(string, uniform(10), Lumping::cells);
    EXPECT_EQ(mesh.node[0].outer_radius, 0.05);
    EXPECT_EQ(mesh.node[4].outer_radius, 0.05);
    EXPECT_EQ(mesh.node[5].outer_radius, 0.10);  // a joint: the larger one
    EXPECT_EQ(mesh.node[9].outer_radius, 0.10);
    EXPECT_EQ(mesh.node[10].outer_radius, 0.075);  // the bit
}

}  // namespace
}  // namespace drillstrand
