/// Critical loads and modes of the straight string against exact solutions, and its Hessian against
/// the energy of the rod itself.
#include "drillstrand/buckling.hpp"

#include <gmock/gmock.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>

#include "support/run_case.hpp"

namespace drillstrand {
namespace {

constexpr double pi = std::numbers::pi;

/// Table 3 of Galasso, Santelli, Zambetti, Giusteri (2024), with more lines for the case.
std::string column(int segments, const std::string& head = "gravity = 0\n",
                   const std::string& tail = "") {
    return "title = \"Column\"\n" + head +
           "[[string.component]]\nname = \"pipe\"\nlength = 1000\nouter_diameter = 0.14\n"
           "inner_diameter = 0.12\nlinear_density = 31.8557\nyoungs_modulus = \"200 GPa\"\n"
           "poisson_ratio = 0.0\n[mesh]\nsegments = " +
           std::to_string(segments) + "\n[run]\nduration = 1\n" + tail;
}

constexpr double column_stiffness = 1735729.9411083623;  // EI of table 3 (N m2)
constexpr double column_density = 31.8557;               // kg/m

constexpr double heavy_load = 5638.333566;  // N, of the hanging column: below

/// The scene with nodes at the tip that weigh as end-corrected quadrature of fourth order has it
/// (Gregory's rule): 5/12 and 13/12 of a segment.
Scene scene_of(const std::string& toml) {
    Scene scene = build_scene(test::case_from(toml));
    const double h = scene.mesh.length.back();
    scene.mesh.cell.end()[-1] = 5 * h / 12;
    scene.mesh.cell.end()[-2] = 13 * h / 12;
    return scene;
}

StraightRod rod_of(const std::string& toml) {
    return straight_rod(scene_of(toml), Discretisation::beam_column);
}

StraightRod paper_rod(const std::string& toml) {
    return straight_rod(scene_of(toml), Discretisation::paper);
}

/// With half a segment's weight at the tip.
StraightRod mended_paper_rod(const std::string& toml) {
    const Scene scene = scene_of(toml);
    StraightRod rod = straight_rod(scene, Discretisation::paper);
    for (double& weight : rod.weight_below)
        weight -= scene.weight.back() * scene.mesh.length.back() / 2;
    return rod;
}

double first_load(const StraightRod& rod) {
    return buckling_modes(rod, 1).front().load;
}

/// Load of the weightless column in pair `index` (N).
double euler_load(std::size_t index) {
    return column_stiffness * std::pow((static_cast<double>(index) + 0.5) * pi / 1000, 2);
}

/// A rod of equal segments without weight.
StraightRod uniform_rod(std::size_t segments, double length, double axial, double shear,
                        double bending) {
    const auto all = [&](double value) { return std::vector<double>(segments, value); };
    return {all(length / static_cast<double>(segments)), all(axial), all(shear), all(bending),
            all(0)};
}

StraightRod as_the_paper(StraightRod rod) {
    rod.discretisation = Discretisation::paper;
    return rod;
}

/// Without stretch and shear, which change loads of a slender column by some 1e-5 at most.
StraightRod inextensible(StraightRod rod) {
    for (auto* stiffness : {&rod.axial_stiffness, &rod.shear_stiffness})
        for (double& value : *stiffness)
            value *= 1e6;
    return rod;
}

/// The two meshes, the second twice as fine, must be off by four to one (second order), within 2 %.
void expect_second_order(double coarse, double fine, double exact) {
    EXPECT_NEAR((coarse - exact) / (fine - exact), 4, 0.08);
}

/// As above, sixteen to one (fourth order), within 4 %.
void expect_fourth_order(double coarse, double fine, double exact) {
    EXPECT_NEAR((coarse - exact) / (fine - exact), 16, 0.64);
}

/// Limit of a second-order sequence from two meshes, the second twice as fine.
double extrapolated(double coarse, double fine) {
    return fine + (fine - coarse) / 3;
}

/// The root of a function that changes sign once between two points.
double root(const std::function<double(double)>& function, double low, double high) {
    const bool rises = function(high) > 0;
    for (int i = 0; i < 200; ++i) {
        const double middle = 0.5 * (low + high);
        ((function(middle) > 0) == rises ? high : low) = middle;
    }
    return low;
}

TEST(Buckling, WeightlessColumnHasEulersLoads) {
    // Beam-columns bend as the column does: nothing is left but its stretch, F/EA = 1e-7.
    const std::vector<BucklingMode> modes = buckling_modes(rod_of(column(20)), 6);
    ASSERT_EQ(modes.size(), 6U);
    for (std::size_t pair = 0; pair < 3; ++pair) {
        EXPECT_NEAR(modes[2 * pair].load, euler_load(pair), 2e-7 * euler_load(pair));
        EXPECT_EQ(modes[2 * pair].load, modes[2 * pair + 1].load);
    }
}

TEST(Buckling, HeavyColumnConvergesToTheContinuumAtFourthOrder) {
    // Ai'(-F / (w m)) = 0 with m = (EI/w)^(1/3): F = 1.01879297165 w m.
    const auto load = [](int segments) {
        return first_load(rod_of(column(segments, "gravity = 9.81\n")));
    };
    EXPECT_NEAR(load(70), heavy_load, 0.01 * heavy_load);
    EXPECT_NEAR(load(140), heavy_load, 0.001 * heavy_load);
    const auto pure_load = [](int segments) {
        return first_load(inextensible(rod_of(column(segments, "gravity = 9.81\n"))));
    };
    expect_fourth_order(pure_load(280), pure_load(560), heavy_load);
}

TEST(Buckling, WeightlessColumnOfThePaperHasTheLoadsOfTheDiscreteEnergy) {
    // Dense Hessian of the energy of N segments joined by exponential maps, independent program.
    const std::vector<BucklingMode> modes = buckling_modes(paper_rod(column(20)), 6);
    const std::vector<double> published = {4.284943905, 38.72332621, 108.4514373};
    for (std::size_t pair = 0; pair < 3; ++pair)
        EXPECT_NEAR(modes[2 * pair].load, published[pair], 1e-8 * published[pair]);
}

TEST(Buckling, WeightlessColumnOfThePaperConvergesToEulersLoadsAtSecondOrder) {
    const std::vector<BucklingMode> coarse = buckling_modes(paper_rod(column(80)), 5);
    const std::vector<BucklingMode> fine = buckling_modes(paper_rod(column(160)), 5);
    for (std::size_t mode : {0U, 2U, 4U}) {
        const double euler = euler_load(mode / 2);
        expect_second_order(coarse[mode].load, fine[mode].load, euler);
        EXPECT_NEAR(extrapolated(coarse[mode].load, fine[mode].load), euler, 1e-5 * euler);
    }
}

TEST(Buckling, HeavyColumnOfThePaperHasTheLoadOfItsEnergy) {
    // As the weightless column: dense Hessian, independent program.
    EXPECT_NEAR(first_load(paper_rod(column(70, "gravity = 9.81\n"))), 8275.664805, 1e-6);
}

TEST(Buckling, HeavyColumnOfThePaperConvergesAtSecondOrderWithHalfItsWeightAtTheTip) {
    const auto load = [](int segments) {
        return first_load(mended_paper_rod(column(segments, "gravity = 9.81\n")));
    };
    EXPECT_NEAR(load(70), 6043.490, 1e-3);
    const double coarse = load(500);
    const double fine = load(1000);
    expect_second_order(coarse, fine, heavy_load);
    EXPECT_NEAR(extrapolated(coarse, fine), heavy_load, 1e-5 * heavy_load);
}

TEST(Buckling, ShippedCasesHaveTheLoadsThatTheyName) {
    const auto load = [](const std::string& name, Discretisation discretisation) {
        const Case input = read_case(DRILLSTRAND_SOURCE_DIR "/cases/" + name);
        return first_load(straight_rod(build_scene(input), discretisation));
    };
    const std::string weightless = "buckling_weightless.toml";
    EXPECT_NEAR(load(weightless, Discretisation::beam_column), 4.282742, 1e-6);
    EXPECT_NEAR(load(weightless, Discretisation::paper), 4.284943905, 1e-8);
    EXPECT_NEAR(load("buckling_heavy.toml", Discretisation::paper), 8275.665, 1e-3);
}

TEST(Buckling, FluidCarriesPartOfTheWeight) {
    const std::string fluid = "[fluid]\ndensity = 1000\nviscosity = 0\n";
    const std::string gravity = "gravity = 9.81\n";
    const double load = first_load(rod_of(column(500, gravity, fluid)));
    const double area = pi / 4 * (0.14 * 0.14 - 0.12 * 0.12);
    const double weight = (column_density - 1000 * area) * 9.81;
    const double exact = 1.01879297165 * weight * std::cbrt(column_stiffness / weight);
    EXPECT_NEAR(load, exact, 1e-5 * exact);
}

TEST(Buckling, AStandingColumnOfGreenhillsHeightNeedsNoLoad) {
    // w L^3 / EI = 7.837347439: 9/4 of the squared first zero of the Bessel function J_(-1/3).
    const double gravity = 7.837347439 * column_stiffness / (column_density * 1e9);
    const auto load = [&](int segments) {
        return first_load(
            rod_of(column(segments, "gravity = " + std::to_string(1e6 * gravity) + "e-6\n",
                          "[head]\ndirection = [0, 0, -1]\n")));
    };
    EXPECT_NEAR(load(20), 0, 1e-4 * euler_load(0));
    EXPECT_NEAR(load(80), 0, 1e-6 * euler_load(0));
}

TEST(Buckling, WeightAcrossALevelRodLeavesItsLoadsAlone) {
    const std::string level = "[head]\ndirection = [1, 0, 0]\n";
    EXPECT_EQ(first_load(rod_of(column(20, "gravity = 9.81\n", level))),
              first_load(rod_of(column(20))));
}

/// First load of a column with shear and stretch: a rotation t(s) has the energy
/// EI t'^2 - (F (1 - F/EA) + F^2/kGA) t^2 per length, so that the bracket takes Euler's place.
double stocky_load(double axial, double shear, double euler) {
    return root(
        [&](double force) { return force * (1 - force / axial) + force * force / shear - euler; },
        0, 2 * euler);
}

TEST(Buckling, StretchAndShearOfAStockyColumnOfThePaperMatter) {
    const auto load = [&](std::size_t segments) {
        return first_load(as_the_paper(uniform_rod(segments, 2, 300, 90, 7)));
    };
    const double euler = 7 * pi * pi / 16;
    const double exact = stocky_load(300, 90, euler);
    EXPECT_GT(std::abs(exact - euler), 0.03 * euler);
    expect_second_order(load(40), load(80), exact);
    EXPECT_NEAR(extrapolated(load(40), load(80)), exact, 1e-7 * exact);
}

TEST(Buckling, StretchAndShearOfAColumnMatterToFirstOrder) {
    // A beam-column's chord carries its axial force, the column's sections do: a part F/kGA, 0.5 %,
    // of what shear changes.
    const StraightRod rod = uniform_rod(20, 2, 9000, 900, 7);
    const double euler = 7 * pi * pi / 16;
    const double exact = stocky_load(9000, 900, euler);
    EXPECT_GT(euler - exact, 4e-3 * euler);
    EXPECT_NEAR(first_load(rod), exact, 3e-5 * exact);
    // Rotation sin(q s): bending q cos(q s), shear -F/kGA sin(q s).
    const double q = pi / 4;
    const double amplitude = q / (1 - exact / 9000 + exact / 900);  // the tip moves by 1 m
    const BucklingMode mode = buckling_modes(rod, 1).front();
    for (std::size_t i = 0; i < mode.strain.size(); ++i) {
        const double s = 0.1 * (static_cast<double>(i) + 0.5);
        EXPECT_NEAR(std::abs(mode.strain[i][1]), amplitude * q * std::cos(q * s), 1e-4);
        EXPECT_NEAR(mode.strain[i][5] * mode.strain[i][1],
                    -exact / 900 * std::sin(q * s) * std::cos(q * s) * q * amplitude * amplitude,
                    1e-5);
    }
}

TEST(Buckling, AStringOfTwoComponentsHasTheLoadsOfTheSteppedColumn) {
    // Rotation sin(k1 s) above and A cos(k2 (L - s)) below the joint, rotation and moment
    // continuous: tan(k1 L1) tan(k2 L2) = EI1 k1 / (EI2 k2).
    const auto toml = [](int segments) {
        return "title = \"Stepped\"\ngravity = 0\n[[string.component]]\nname = \"upper\"\n"
               "length = 60\nouter_diameter = 0.14\ninner_diameter = 0.12\n"
               "linear_density = 31.8557\nyoungs_modulus = \"200 GPa\"\n"
               "[[string.component]]\nname = \"lower\"\nlength = 40\nouter_diameter = 0.11\n"
               "inner_diameter = 0.08\nlinear_density = 31.8557\nyoungs_modulus = \"150 GPa\"\n"
               "[mesh]\nsegments = " +
               std::to_string(segments) + "\n[run]\nduration = 1\n";
    };
    const auto stiffness = [](double outer, double inner, double modulus) {
        return modulus * pi / 64 * (std::pow(outer, 4) - std::pow(inner, 4));
    };
    const double upper = stiffness(0.14, 0.12, 200e9);
    const double lower = stiffness(0.11, 0.08, 150e9);
    const auto mismatch = [&](double force) {
        const double k1 = std::sqrt(force / upper);
        const double k2 = std::sqrt(force / lower);
        return lower * k2 * std::sin(60 * k1) * std::sin(40 * k2) -
               upper * k1 * std::cos(60 * k1) * std::cos(40 * k2);
    };
    const double least = std::min(upper, lower) * pi * pi / 4e4;
    const double most = std::max(upper, lower) * pi * pi / 4e4;
    const double exact = root(mismatch, least, most);
    // Stretch and shear change the load by F/EA, here 3e-7.
    EXPECT_NEAR(first_load(rod_of(toml(10))), exact, 2e-6 * exact);
}

TEST(Buckling, ModesOfTheWeightlessColumnAreCosines) {
    // Deflection 1 - cos(k s), bending k^2 cos(k s), with k = (n - 1/2) pi / L.
    const int segments = 20;
    const std::vector<BucklingMode> modes = buckling_modes(rod_of(column(segments)), 6);
    for (std::size_t mode = 0; mode < modes.size(); ++mode) {
        const double k = (static_cast<double>(mode / 2) + 0.5) * pi / 1000;
        const Eigen::Index bending = mode % 2 == 0 ? 1 : 2;
        const double scale = modes[mode].strain.front()[bending] / std::cos(k * 25);
        for (std::size_t i = 0; i < modes[mode].strain.size(); ++i) {
            const Vector6& strain = modes[mode].strain[i];
            const double s = 1000 * (static_cast<double>(i) + 0.5) / segments;
            EXPECT_NEAR(strain[bending], scale * std::cos(k * s), 1e-9 * std::abs(scale));
        }
        // The largest deflection is 1 m, so that the amplitude is k^2 in the first pair.
        if (mode < 2) {
            EXPECT_NEAR(std::abs(scale), k * k, 1e-6 * k * k);
        }
    }
}

using Real = long double;
using Variables = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

/// Second derivatives by central differences of fourth order in steps of `scale`.
class SecondDifferences {
  public:
    SecondDifferences(std::function<Real(const Variables&)> energy, Variables base, Variables scale)
        : energy_(std::move(energy)), base_(std::move(base)), scale_(std::move(scale)) {}

    [[nodiscard]] Eigen::MatrixXd hessian() const {
        Eigen::MatrixXd hessian(base_.size(), base_.size());
        for (Eigen::Index a = 0; a < base_.size(); ++a)
            for (Eigen::Index b = a; b < base_.size(); ++b) {
                const Real step = 5e-4L;
                const Real fine = mixed_difference(a, b, step);
                const Real coarse = mixed_difference(a, b, 2 * step);
                hessian(a, b) = hessian(b, a) = static_cast<double>((4 * fine - coarse) / 3);
            }
        return hessian;
    }

  private:
    [[nodiscard]] Real mixed_difference(Eigen::Index a, Eigen::Index b, Real step) const {
        Real sum = 0;
        for (const int sign_a : {-1, 1})
            for (const int sign_b : {-1, 1}) {
                Variables moved = base_;
                moved[a] += sign_a * step * scale_[a];
                moved[b] += sign_b * step * scale_[b];
                sum += sign_a * sign_b * energy_(moved);
            }
        return sum / (4 * step * step);
    }

    std::function<Real(const Variables&)> energy_;
    Variables base_;
    Variables scale_;
};

/// A three-dimensional rod in extended precision, written down directly from the energy: segments
/// of constant strain, joined by exponential maps, along the x axis.
class EnergyOfRod {
  public:
    using Vector = Eigen::Matrix<Real, 3, 1>;
    using Matrix = Eigen::Matrix<Real, 3, 3>;
    using Strains = Variables;

    EnergyOfRod(const StraightRod& rod, double torsional_stiffness, double load)
        : rod_(rod), torsion_(torsional_stiffness), load_(load) {}

    /// Strains of the straight rod under its loads.
    [[nodiscard]] Strains straight() const {
        Strains strains = Strains::Zero(size());
        for (std::size_t i = 0; i < rod_.length.size(); ++i)
            strains[row(i) + 3] =
                1 + (Real(rod_.weight_below[i]) - load_) / rod_.axial_stiffness[i];
        return strains;
    }

    [[nodiscard]] Real operator()(const Strains& strains) const {
        Matrix frame = Matrix::Identity();
        Real position = 0;
        Real energy = 0;
        const std::size_t segments = rod_.length.size();
        for (std::size_t i = 0; i < segments; ++i) {
            const Real h = rod_.length[i];
            const Vector turn = h * strains.template segment<3>(row(i));
            const Vector advance = strains.template segment<3>(row(i) + 3);
            energy += h / 2 * stored(i, strains);
            position += (frame * (mean_rotation(turn) * (h * advance))).x();
            frame = frame * rotation(turn);
            // Weight of the node between this segment and the next; the load acts at the last one.
            const Real next = i + 1 < segments ? Real(rod_.weight_below[i + 1]) : Real(load_);
            energy -= (Real(rod_.weight_below[i]) - next) * position;
        }
        return energy;
    }

    /// For turns h k and strains g.
    [[nodiscard]] Eigen::MatrixXd hessian() const {
        Strains scale = Strains::Ones(size());
        for (std::size_t i = 0; i < rod_.length.size(); ++i)
            scale.segment<3>(row(i)).setConstant(1 / Real(rod_.length[i]));
        return SecondDifferences(*this, straight(), scale).hessian();
    }

    /// Strains of a mode in the variables of hessian().
    [[nodiscard]] Eigen::VectorXd scaled(const std::vector<Vector6>& mode) const {
        Eigen::VectorXd vector(size());
        for (std::size_t i = 0; i < mode.size(); ++i) {
            vector.segment<6>(row(i)) = mode[i];
            vector.segment<3>(row(i)) *= rod_.length[i];
        }
        return vector.normalized();
    }

  private:
    [[nodiscard]] Eigen::Index size() const {
        return 6 * static_cast<Eigen::Index>(rod_.length.size());
    }
    static Eigen::Index row(std::size_t segment) { return 6 * static_cast<Eigen::Index>(segment); }

    [[nodiscard]] Real stored(std::size_t i, const Strains& strains) const {
        const auto u = strains.template segment<6>(row(i));
        return torsion_ * u[0] * u[0] + rod_.bending_stiffness[i] * (u[1] * u[1] + u[2] * u[2]) +
               rod_.axial_stiffness[i] * (u[3] - 1) * (u[3] - 1) +
               rod_.shear_stiffness[i] * (u[4] * u[4] + u[5] * u[5]);
    }

    static Matrix cross(const Vector& turn) {
        Matrix matrix;
        matrix << 0, -turn.z(), turn.y(), turn.z(), 0, -turn.x(), -turn.y(), turn.x(), 0;
        return matrix;
    }

    /// exp(W) and the mean of exp(t W) over t in 0..1, by their series: turns are small here.
    static Matrix rotation(const Vector& turn) { return series(turn, 1); }
    static Matrix mean_rotation(const Vector& turn) { return series(turn, 2); }
    static Matrix series(const Vector& turn, int first) {
        Matrix term = Matrix::Identity();
        Matrix sum = term;
        for (int k = first; k < first + 12; ++k) {
            term = term * cross(turn) / k;
            sum += term;
        }
        return sum;
    }

    const StraightRod& rod_;
    Real torsion_;
    Real load_;
};

/// Beam-columns in a plane in extended precision, written down from the energy that the rod's
/// dynamics have, with coth and cot: places and rotations of nodes 1..N.
class EnergyOfBeamColumns {
  public:
    EnergyOfBeamColumns(const StraightRod& rod, double load) : rod_(rod), load_(load) {}

    [[nodiscard]] Real operator()(const Variables& nodes) const {
        Real energy = 0;
        Node upper{0, 0, 0};
        const std::size_t segments = rod_.length.size();
        for (std::size_t i = 0; i < segments; ++i) {
            const auto row = 3 * static_cast<Eigen::Index>(i);
            const Node lower{nodes[row], nodes[row + 1], nodes[row + 2]};
            const Real next = i + 1 < segments ? Real(rod_.weight_below[i + 1]) : Real(load_);
            energy += stored(i, upper, lower) - (Real(rod_.weight_below[i]) - next) * lower.along;
            upper = lower;
        }
        return energy;
    }

    [[nodiscard]] Eigen::MatrixXd hessian() const {
        const std::size_t segments = rod_.length.size();
        Variables straight = Variables::Zero(3 * static_cast<Eigen::Index>(segments));
        Real place = 0;
        for (std::size_t i = 0; i < segments; ++i) {
            place += rod_.length[i] *
                     (1 + (Real(rod_.weight_below[i]) - load_) / rod_.axial_stiffness[i]);
            straight[3 * static_cast<Eigen::Index>(i)] = place;
        }
        return SecondDifferences(*this, straight, Variables::Ones(straight.size())).hessian();
    }

  private:
    struct Node {
        Real along, across, rotation;
    };

    [[nodiscard]] Real stored(std::size_t i, const Node& upper, const Node& lower) const {
        const Real h = rod_.length[i];
        const Real dx = lower.along - upper.along;
        const Real dy = lower.across - upper.across;
        const Real bend = lower.rotation - upper.rotation;
        const Real angle = std::atan2(dy, dx) - (upper.rotation + lower.rotation) / 2;
        const Real strain =
            std::hypot(dx, dy) / h * (1 + bend * bend / 24 + angle * angle / 10) - 1;
        const Real z = rod_.axial_stiffness[i] * strain * h * h / rod_.bending_stiffness[i];
        const Real x = std::sqrt(std::abs(z)) / 2;
        const Real symmetric = z > 0 ? x / std::tanh(x) : x / std::tan(x);
        const Real antisymmetric = z / (12 * (symmetric - 1));
        const Real stiffness = rod_.bending_stiffness[i] / h;
        const Real share = 1 / (1 + 12 * stiffness / (h * rod_.shear_stiffness[i]));
        return h * rod_.axial_stiffness[i] * strain * strain / 2 +
               stiffness * ((symmetric - z / 12) * bend * bend / 2 +
                            6 * share * (antisymmetric - z / 60) * angle * angle);
    }

    const StraightRod& rod_;
    Real load_;
};

/// A short string of uneven segments with weight, so soft that stretch and shear matter.
StraightRod random_rod(std::size_t segments, std::mt19937& random) {
    const auto number = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    StraightRod rod;
    for (std::size_t i = 0; i < segments; ++i) {
        rod.length.push_back(number(0.5, 1.5));
        rod.axial_stiffness.push_back(number(60, 90));
        rod.shear_stiffness.push_back(number(10, 40));
        rod.bending_stiffness.push_back(number(1, 4));
        rod.weight_below.push_back(number(0, 0.5));
    }
    for (std::size_t i = segments - 1; i-- > 0;)
        rod.weight_below[i] += rod.weight_below[i + 1];
    return rod;
}

std::size_t negative_eigenvalues(const Eigen::MatrixXd& matrix) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix, Eigen::EigenvaluesOnly);
    return static_cast<std::size_t>((solver.eigenvalues().array() < 0).count());
}

class RandomRod : public testing::TestWithParam<unsigned> {};

TEST_P(RandomRod, ModesOfThePaperAnnulTheHessianOfItsEnergy) {
    std::mt19937 random(GetParam());
    const StraightRod rod = as_the_paper(random_rod(5, random));
    for (const BucklingMode& mode : buckling_modes(rod, 6)) {
        const EnergyOfRod energy(rod, 2.0, mode.load);
        const Eigen::MatrixXd hessian = energy.hessian();
        const Eigen::VectorXd force = hessian * energy.scaled(mode.strain);
        // Differences are good to about 1e-11 of the largest entry.
        EXPECT_LT(force.norm(), 1e-9 * hessian.cwiseAbs().maxCoeff());
    }
}

TEST_P(RandomRod, NoInstabilityOfThePaperIsMissed) {
    std::mt19937 random(GetParam());
    const StraightRod rod = as_the_paper(random_rod(5, random));
    const std::vector<BucklingMode> modes = buckling_modes(rod, 6);
    for (std::size_t pair = 0; pair < 3; ++pair) {
        const double load = modes[2 * pair].load;
        const double nudge = 1e-6 * std::abs(load);
        const auto count = [&](double force) {
            return negative_eigenvalues(EnergyOfRod(rod, 2.0, force).hessian());
        };
        EXPECT_EQ(count(load - nudge), 2 * pair);
        EXPECT_EQ(count(load + nudge), 2 * pair + 2);
    }
}

TEST_P(RandomRod, NoInstabilityOfBeamColumnsIsMissed) {
    std::mt19937 random(GetParam());
    const StraightRod rod = random_rod(5, random);
    const std::size_t pairs = count_buckling_modes(rod) / 2;
    ASSERT_GE(pairs, 2U);
    const std::vector<BucklingMode> modes = buckling_modes(rod, 2 * pairs);
    for (std::size_t pair = 0; pair < pairs; ++pair) {
        const double load = modes[2 * pair].load;
        const double nudge = 1e-6 * std::abs(load);
        const auto count = [&](double force) {
            return negative_eigenvalues(EnergyOfBeamColumns(rod, force).hessian());
        };
        EXPECT_EQ(count(load - nudge), pair);
        EXPECT_EQ(count(load + nudge), pair + 1);
    }
}

/// Eigenvalues, ascending, of the energy in the bending of segments, all other strains being free,
/// against the integral of the squared curvature.
Eigen::VectorXd bending_eigenvalues(const StraightRod& rod, const Eigen::MatrixXd& hessian) {
    std::vector<Eigen::Index> bending;
    std::vector<Eigen::Index> others;
    for (Eigen::Index row = 0; row < hessian.rows(); ++row)
        (row % 6 == 1 || row % 6 == 2 ? bending : others).push_back(row);
    const Eigen::MatrixXd mixed = hessian(others, bending);
    const Eigen::MatrixXd condensed =
        hessian(bending, bending) - mixed.transpose() * hessian(others, others).llt().solve(mixed);
    Eigen::VectorXd flexibility(std::ssize(bending));  // curvature squared from h k squared
    for (Eigen::Index k = 0; k < flexibility.size(); ++k)
        flexibility[k] = 1 / rod.length[static_cast<std::size_t>(k / 2)];
    return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(
               condensed, flexibility.asDiagonal().toDenseMatrix())
        .eigenvalues();
}

TEST_P(RandomRod, EigenvaluesOfThePaperAreThoseOfItsHessian) {
    std::mt19937 random(GetParam());
    const StraightRod rod = as_the_paper(random_rod(5, random));
    const double load = 1.1 * buckling_modes(rod, 5).back().load;
    const Eigen::VectorXd exact = bending_eigenvalues(rod, EnergyOfRod(rod, 2.0, load).hessian());
    const Instability instability = find_instability(rod, load);
    EXPECT_EQ(instability.load, load);
    ASSERT_EQ(instability.modes.size(), 6U);
    for (std::size_t k = 0; k < instability.modes.size(); ++k)
        EXPECT_NEAR(instability.modes[k].eigenvalue, exact[static_cast<Eigen::Index>(k)],
                    1e-8 * std::abs(exact[0]));
    EXPECT_GT(exact[6], 0);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomRod, testing::Values(1U, 2U, 3U, 4U));

TEST(Buckling, ASlenderRodHasTwoModesASegment) {
    EXPECT_EQ(count_buckling_modes(uniform_rod(7, 100, 1e6, 1e6, 1)), 14U);
}

TEST(Buckling, EigenvaluesOfTheWeightlessColumnConvergeAtFourthOrder) {
    // Rotation sin(q s), q^2 = F_n/EI: the energy EI q^2 cos^2 - F sin^2 over q^2 cos^2.
    const double load = 100;
    const Instability coarse = find_instability(inextensible(rod_of(column(40))), load);
    const Instability fine = find_instability(inextensible(rod_of(column(80))), load);
    ASSERT_EQ(coarse.modes.size(), 4U);
    for (std::size_t k = 0; k < 4; ++k) {
        const double exact = column_stiffness * (1 - load / euler_load(k / 2));
        EXPECT_NEAR(fine.modes[k].eigenvalue, exact, 1e-5 * std::abs(exact));
    }
    const double exact = column_stiffness * (1 - load / euler_load(1));
    expect_fourth_order(coarse.modes[2].eigenvalue, fine.modes[2].eigenvalue, exact);
}

std::vector<double> bending_of(const std::vector<Vector6>& strain) {
    std::vector<double> bending;
    for (const Vector6& segment : strain)
        bending.push_back(segment[1]);
    return bending;
}

/// Of values that stand out. Where tension is strong for the mesh, the segment of the paper bends
/// to and fro by next to nothing.
std::size_t sign_changes(const std::vector<double>& values) {
    double most = 0;
    for (const double value : values)
        most = std::max(most, std::abs(value));
    std::size_t changes = 0;
    double last = 0;
    for (const double value : values) {
        if (std::abs(value) < 1e-6 * most) continue;
        if (value * last < 0) ++changes;
        last = value;
    }
    return changes;
}

TEST(Buckling, EigenvaluesOfTheHeavyColumnAreThoseOfItsAiryFunctions) {
    // The critical load goes with the cube root of the stiffness, in which EI less the eigenvalue
    // takes the place of EI: it is EI (F/F_n)^3.
    const double load = 30e3;
    const StraightRod rod = rod_of(column(560, "gravity = 9.81\n"));
    const std::vector<BucklingMode> modes = buckling_modes(rod, 6);
    const Instability instability = find_instability(rod, load);
    ASSERT_EQ(instability.modes.size(), 6U);
    for (std::size_t k = 0; k < 6; ++k)
        EXPECT_NEAR(column_stiffness - instability.modes[k].eigenvalue,
                    column_stiffness * std::pow(load / modes[k].load, 3),
                    1e-4 * std::abs(instability.modes[k].eigenvalue));
}

class HeavyRod : public testing::TestWithParam<Discretisation> {
  public:
    static StraightRod rod(int segments) {
        return straight_rod(scene_of(column(segments, "gravity = 9.81\n")), GetParam());
    }
};

TEST_P(HeavyRod, AsManyShapesAreUnstableAsModesHaveALowerLoad) {
    const StraightRod heavy = rod(50);
    const std::vector<BucklingMode> modes = buckling_modes(heavy, 8);
    for (std::size_t pair = 0; pair < 4; ++pair) {
        const double load = modes[2 * pair].load;
        EXPECT_EQ(find_instability(heavy, load * (1 - 1e-9)).modes.size(), 2 * pair);
        const Instability above = find_instability(heavy, load * (1 + 1e-9));
        ASSERT_EQ(above.modes.size(), 2 * pair + 2);
        EXPECT_GT(above.modes.back().eigenvalue, -1e-6 * column_stiffness);
        EXPECT_LT(above.modes.back().eigenvalue, 0);
    }
}

TEST_P(HeavyRod, AtItsCriticalLoadAModeIsTheUnstableShape) {
    const StraightRod heavy = rod(50);
    const BucklingMode mode = buckling_modes(heavy, 1).front();
    const Instability above = find_instability(heavy, mode.load * (1 + 1e-9));
    for (std::size_t i = 0; i < mode.strain.size(); ++i)
        EXPECT_NEAR(above.modes[0].strain[i][1], mode.strain[i][1], 1e-8);
}

TEST_P(HeavyRod, BendsNearItsCompressedPartAndEachShapeOnceMoreToAndFro) {
    // Figure 12 of the paper. Rotations are Airy functions of s/m from the neutral point, F/w above
    // the tip, as at a critical load, with EI less the eigenvalue in m: at most F/w. Bending dies
    // out within three m.
    const double load = 35e3;
    const double bent = 1000 - 4 * load / (column_density * 9.81);
    const Instability instability = find_instability(rod(50), load);
    ASSERT_GE(instability.modes.size(), 4U);
    for (std::size_t k = 0; k < instability.modes.size(); k += 2) {
        const std::vector<double> bending = bending_of(instability.modes[k].strain);
        EXPECT_EQ(sign_changes(bending), k / 2);
        double above = 0;
        double below = 0;
        for (std::size_t i = 0; i < bending.size(); ++i)
            (20 * (static_cast<double>(i) + 0.5) < bent ? above : below) += bending[i] * bending[i];
        EXPECT_LT(above, 1e-3 * below);
    }
}

INSTANTIATE_TEST_SUITE_P(Both, HeavyRod,
                         testing::Values(Discretisation::beam_column, Discretisation::paper),
                         [](const auto& of) {
                             return of.param == Discretisation::paper ? "Paper" : "BeamColumn";
                         });

TEST(Buckling, ALoadThatTheMeshCannotFollowIsRefused) {
    // Half a wave in each of 20 segments of 50 m.
    const StraightRod rod = rod_of(column(20));
    const double highest = column_stiffness * pi * pi / 2500;
    EXPECT_NEAR(highest_buckling_load(rod), highest, 1e-4 * highest);
    EXPECT_EQ(find_instability(rod, 0.999 * highest).modes.size(), 40U);
    EXPECT_THROW(find_instability(rod, 1.001 * highest), std::invalid_argument);
    EXPECT_THROW(find_instability(rod, std::nan("")), std::invalid_argument);
    EXPECT_TRUE(find_instability(rod, -1e9).modes.empty());
}

TEST(Buckling, AStockyRodHasNoModesThatWouldHalveItsLength) {
    // Euler's load of the second pair, 9 pi^2/4 = 22, is beyond EA/2.
    EXPECT_EQ(count_buckling_modes(uniform_rod(20, 1, 20, 1e6, 1)), 2U);
}

TEST(Buckling, ModesThatDoNotExistAreRefused) {
    EXPECT_THROW(buckling_modes(uniform_rod(7, 100, 1e6, 1e6, 1), 15), std::invalid_argument);
}

TEST(Buckling, AStringBentWhenUnstressedIsRefused) {
    const Scene scene = build_scene(test::case_from(
        "title = \"Bent\"\n[[string.component]]\nname = \"bent sub\"\nlength = 10\n"
        "outer_diameter = 0.14\ninner_diameter = 0.12\nlinear_density = 31.8557\n"
        "youngs_modulus = \"200 GPa\"\ncurvature = [0, 0.01, 0]\n[mesh]\nsegments = 4\n"
        "[run]\nduration = 1\n"));
    EXPECT_THROW(straight_rod(scene, Discretisation::beam_column), std::invalid_argument);
}

TEST(Buckling, AStringThatItsWeightWouldTearIsRefused) {
    StraightRod rod = as_the_paper(uniform_rod(4, 1, 100, 10, 1));
    rod.weight_below = {6, 4, 2, 0};
    EXPECT_THROW(count_buckling_modes(rod), std::invalid_argument);
}

}  // namespace
}  // namespace drillstrand
