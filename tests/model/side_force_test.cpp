// Side force: the wall's normal force per length over a window.
#include "drillstrand/side_force.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace drillstrand {
namespace {

constexpr double window = 9.144;  // m

std::vector<double> even_nodes(double length, int segments) {
    std::vector<double> node_s;
    for (int k = 0; k <= segments; ++k)
        node_s.push_back(length * k / segments);
    return node_s;
}

TEST(SideForce, OfAnEvenForceIsThatForceEverywhere) {
    const std::vector<double> node_s = even_nodes(100, 17);
    const std::vector<double> mean =
        side_force(node_s, std::vector<double>(18, 420.0), window, node_s);
    for (const double value : mean)
        EXPECT_NEAR(value, 420.0, 1e-11);
}

TEST(SideForce, OfOnePointLoadIsItsForceOverTheWindowOnAnyMesh) {
    // 5 kN at 50 m, carried by the cell of the node there: 5, 2.5 and 1.25 m long
    for (const int segments : {20, 40, 80}) {
        const std::vector<double> node_s = even_nodes(100, segments);
        std::vector<double> force(node_s.size(), 0.0);
        force[static_cast<std::size_t>(segments) / 2] = 5000 / (100.0 / segments);
        EXPECT_NEAR(side_force(node_s, force, window, {50.0}).front(), 5000 / window, 1e-9);
        EXPECT_EQ(side_force(node_s, force, window, {60.0}).front(), 0);
    }
}

TEST(SideForce, ThatZigzagsFromNodeToNodeIsSmoothOverItsWindow) {
    const std::vector<double> node_s = even_nodes(200, 100);
    std::vector<double> force;
    for (std::size_t k = 0; k < node_s.size(); ++k)
        force.push_back(k % 2 == 0 ? 900.0 : 100.0);
    for (const double value : side_force(node_s, force, 20, {60, 80.5, 101}))
        EXPECT_NEAR(value, 500, 0.1 * 400);
}

TEST(SideForce, OverTheWholeStringIsAllOfItOverItsLength) {
    const std::vector<double> node_s = {0, 3, 10, 12};
    const std::vector<double> force = {100, 20, 0, 50};
    const double all = 100 * 1.5 + 20 * 5.0 + 50 * 1.0;
    EXPECT_NEAR(side_force(node_s, force, 1000, {6}).front(), all / 12, 1e-12);
}

TEST(SideForce, AtAnEndIsThatOfTheHalfWindowThatIsThere) {
    const std::vector<double> node_s = even_nodes(100, 50);
    std::vector<double> force(node_s.size(), 0.0);
    force.back() = 700;  // on the last metre
    EXPECT_NEAR(side_force(node_s, force, 8, {100}).front(), 700 * 1.0 / 4, 1e-12);
}

}  // namespace
}  // namespace drillstrand
