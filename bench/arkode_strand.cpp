#include "arkode_strand.hpp"

#include <arkode/arkode_arkstep.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_band.h>
#include <sunlinsol/sunlinsol_spgmr.h>
#include <sunmatrix/sunmatrix_band.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "forces/surroundings.hpp"
#include "forces/well_frame.hpp"
#include "model/pose.hpp"
#include "rod/report.hpp"
#include "rod/strand_state.hpp"

namespace drillstrand::bench {

namespace {

// The vector of unknowns: momenta of node 0, stresses of segment 0, momenta of node 1, and so on.
constexpr std::size_t stride = Table<StrandRow>::lines;
constexpr std::size_t momenta = 6;  // lines of momenta, then those of stresses
// Farthest unknowns that meet in one equation: momenta of neighbours, through the damping.
constexpr sunindextype half_band = 17;
constexpr sunindextype colours = 2 * half_band + 2;

void check(int flag, const char* what) {
    if (flag < 0) {
        throw std::runtime_error(std::string("ARKODE: ") + what + " failed with code " +
                                 std::to_string(flag));
    }
}

template <class Pointer>
Pointer created(Pointer pointer, const char* what) {
    if (pointer == nullptr) throw std::runtime_error(std::string("ARKODE: no ") + what);
    return pointer;
}

std::vector<Pose> initial_poses(const Scene& scene) {
    return poses_from_strains({scene.head_frame, scene.head_position}, scene.mesh.length,
                              scene.initial_strain);
}

std::vector<Eigen::Vector3d> positions(const std::vector<Pose>& poses) {
    std::vector<Eigen::Vector3d> position;
    for (const Pose& pose : poses)
        position.push_back(pose.position);
    return position;
}

/// Typical sizes of momenta and stresses of a scene, row by row: the string's weight for forces, a
/// bend of 1 km radius for moments, and for momenta what waves of these sizes carry.
Vector6 typical_stress(const Scene& scene) {
    double weight = 0;
    for (std::size_t k = 0; k < scene.weight.size(); ++k)
        weight += scene.mesh.cell[k] * scene.weight[k];
    const double moment = 1e-3 * scene.mesh.segment.front().bending_stiffness;
    Vector6 size;
    size << moment, moment, moment, weight, weight, weight;
    return size;
}

Vector6 typical_momentum(const Scene& scene) {
    const SectionProperties& section = scene.mesh.segment.front();
    Vector6 speed;
    speed << std::sqrt(section.torsional_stiffness / section.polar_inertia),
        std::sqrt(section.bending_stiffness / scene.inertia.front()),
        std::sqrt(section.bending_stiffness / scene.inertia.front()),
        std::sqrt(section.axial_stiffness / section.mass),
        std::sqrt(section.shear_stiffness / scene.lateral_mass.front()),
        std::sqrt(section.shear_stiffness / scene.lateral_mass.front());
    return typical_stress(scene).cwiseQuotient(speed);
}

}  // namespace

struct ArkodeStrand::Solver {
    Solver(const Scene& the_scene, double tolerance, int order);
    ~Solver();
    Solver(const Solver&) = delete;
    Solver& operator=(const Solver&) = delete;

    void read(const double* y, double t);
    void evaluate(bool hold_pose);
    void write_rate(double* y) const;
    void load_bit(double t);
    void precondition(double t, const double* y, double gamma);
    void follow_surroundings(double step);

    const Scene& scene;
    StrandString string;
    const StrandModel& model = string.model;
    HeadState head;
    Table<WallRow> wall;
    StrandWorkspace work;
    Table<StrandRow> state;
    Table<StrandRow> rate;
    Table<StrandWorkRow> held_pose;  ///< a copy of the workspace whose poses stay
    std::vector<Pose> block_start;
    std::size_t unknowns;
    std::int64_t evaluations = 0;
    double time = 0;

    SUNContext context = nullptr;
    N_Vector vector = nullptr;
    N_Vector absolute = nullptr;
    N_Vector right_side = nullptr;
    SUNLinearSolver krylov = nullptr;
    SUNMatrix band = nullptr;
    SUNLinearSolver band_solver = nullptr;
    void* memory = nullptr;
};

ArkodeStrand::Solver::Solver(const Scene& the_scene, double tolerance, int order)
    : scene(the_scene),
      string(the_scene),
      head(string.head.start(the_scene.head_frame.col(0))),
      wall(model.surroundings.wall_at(positions(initial_poses(the_scene)))),
      work(model.segments + 1),
      state(model.segments + 1),
      rate(state),
      held_pose(work.table),
      block_start(work.table.blocks()),
      unknowns(stride * static_cast<std::size_t>(the_scene.segments) + 6) {
    if (scene.head.motion == HeadMotion::free)
        throw std::invalid_argument("ArkodeStrand: the head must be driven");
    check(SUNContext_Create(nullptr, &context), "SUNContext_Create");
    const auto size = static_cast<sunindextype>(unknowns);
    vector = created(N_VNew_Serial(size, context), "vector");
    absolute = created(N_VClone(vector), "vector");
    right_side = created(N_VClone(vector), "vector");

    // at rest, with the stresses of the initial strains
    N_VConst(0.0, vector);
    double* y = N_VGetArrayPointer(vector);
    double* least = N_VGetArrayPointer(absolute);
    const Vector6 stress_size = typical_stress(scene);
    const Vector6 momentum_size = typical_momentum(scene);
    for (std::size_t k = 0; k <= model.segments; ++k) {
        const bool last = k == model.segments;
        Vector6 stress = Vector6::Zero();
        if (!last) {
            const SectionProperties& s = scene.mesh.segment[k];
            stress = stiffness_of(s).cwiseProduct(scene.initial_strain[k] - stress_free_strain(s));
        }
        for (std::size_t i = 0; i < 6; ++i) {
            const auto row = static_cast<Eigen::Index>(i);
            least[stride * k + i] = tolerance * momentum_size[row];
            if (last) continue;
            least[stride * k + 6 + i] = tolerance * stress_size[row];
            y[stride * k + 6 + i] = stress[row];
        }
    }

    const auto right_hand_side = [](double t, N_Vector at, N_Vector out, void* data) {
        auto& self = *static_cast<Solver*>(data);
        self.read(N_VGetArrayPointer(at), t);
        self.evaluate(false);
        self.write_rate(N_VGetArrayPointer(out));
        return 0;
    };
    const auto prepare = [](double t, N_Vector at, N_Vector, booleantype, booleantype* renewed,
                            double gamma, void* data) {
        static_cast<Solver*>(data)->precondition(t, N_VGetArrayPointer(at), gamma);
        *renewed = SUNTRUE;
        return 0;
    };
    const auto apply = [](double, N_Vector, N_Vector, N_Vector residual, N_Vector out, double,
                          double, int, void* data) {
        auto& self = *static_cast<Solver*>(data);
        return SUNLinSolSolve(self.band_solver, self.band, out, residual, 0.0);
    };
    memory = created(ARKStepCreate(nullptr, right_hand_side, 0.0, vector, context), "integrator");
    krylov = created(SUNLinSol_SPGMR(vector, SUN_PREC_LEFT, 0, context), "Krylov solver");
    band = created(SUNBandMatrix(size, half_band, half_band, context), "band matrix");
    band_solver = created(SUNLinSol_Band(vector, band, context), "band solver");
    check(ARKStepSetUserData(memory, this), "ARKStepSetUserData");
    check(ARKStepSVtolerances(memory, tolerance, absolute), "ARKStepSVtolerances");
    check(ARKStepSetOrder(memory, order), "ARKStepSetOrder");
    check(ARKStepSetLinearSolver(memory, krylov, nullptr), "ARKStepSetLinearSolver");
    check(ARKStepSetPreconditioner(memory, prepare, apply), "ARKStepSetPreconditioner");
}

ArkodeStrand::Solver::~Solver() {
    ARKStepFree(&memory);
    SUNLinSolFree(krylov);
    SUNLinSolFree(band_solver);
    SUNMatDestroy(band);
    N_VDestroy(vector);
    N_VDestroy(absolute);
    N_VDestroy(right_side);
    SUNContext_Free(&context);
}

/// Unknowns into the engine's layout; the head's momentum is prescribed.
void ArkodeStrand::Solver::read(const double* y, double t) {
    time = t;
    for (std::size_t row = 0; row < Table<StrandRow>::lines; ++row) {
        const std::size_t entries = row < momenta ? model.segments + 1 : model.segments;
        double* values = state.line(row);
        for (std::size_t k = 0; k < entries; ++k)
            values[k] = y[stride * k + row];
    }
    string.head.prescribe(state, inertia_of(scene, 0, 0.0), t);
}

void ArkodeStrand::Solver::write_rate(double* y) const {
    for (std::size_t row = 0; row < Table<StrandRow>::lines; ++row) {
        const std::size_t entries = row < momenta ? model.segments + 1 : model.segments;
        const double* values = rate.line(row);
        for (std::size_t k = 0; k < entries; ++k)
            y[stride * k + row] = values[k];
    }
    std::fill_n(y, 6, 0.0);  // the head has no rate of its own
}

/// Rates of the state at hand. With `hold_pose` nodes stay where the evaluation before put them.
void ArkodeStrand::Solver::evaluate(bool hold_pose) {
    const std::size_t blocks = work.table.blocks();
    segment_pass(model, state, rate, work, wall, 0, blocks);
    constexpr std::size_t first_of_pose = 12;  // lines of wrenches come before
    for (std::size_t line = first_of_pose; line < Table<StrandWorkRow>::lines; ++line) {
        double* now = work.table.line(line);
        double* kept = held_pose.line(line);
        if (hold_pose) {
            std::copy_n(kept, model.segments + 1, now);
        } else {
            std::copy_n(now, model.segments + 1, kept);
        }
    }
    if (!hold_pose) chain_blocks(string.head.pose(head, time), work, block_start, blocks);
    load_bit(time);
    node_pass(model, state, rate, work, block_start, wall, 0, blocks);
    ++evaluations;
}

void ArkodeStrand::Solver::load_bit(double t) {
    const std::size_t node = model.segments;
    const Pose pose = node_pose(work, block_start, node);
    set_bit_wrench(work, node, string.bit.stress(bit_motion(string, wall, pose, 0, t), t));
}

/// Factors I - gamma J, J the Jacobian with the pose held. Unknowns that share no equation are
/// moved together.
void ArkodeStrand::Solver::precondition(double t, const double* y, double gamma) {
    std::vector<double> moved(y, y + unknowns);
    std::vector<double> base(unknowns);
    std::vector<double> there(unknowns);
    read(y, t);
    evaluate(false);
    write_rate(base.data());
    const double* least = N_VGetArrayPointer(absolute);
    const auto size = static_cast<sunindextype>(unknowns);
    SUNMatZero(band);
    for (sunindextype colour = 0; colour < std::min(colours, size); ++colour) {
        const auto step = [&](sunindextype column) {
            const auto j = static_cast<std::size_t>(column);
            return 1e-7 * std::abs(y[j]) + 1e-2 * least[j];
        };
        for (sunindextype column = colour; column < size; column += colours)
            moved[static_cast<std::size_t>(column)] += step(column);
        read(moved.data(), t);
        evaluate(true);
        write_rate(there.data());
        for (sunindextype column = colour; column < size; column += colours) {
            const auto j = static_cast<std::size_t>(column);
            const double scale = gamma / (moved[j] - y[j]);
            const sunindextype first = std::max<sunindextype>(0, column - half_band);
            const sunindextype last = std::min<sunindextype>(size - 1, column + half_band);
            double* entries = SUNBandMatrix_Column(band, column);
            for (sunindextype row = first; row <= last; ++row) {
                const auto i = static_cast<std::size_t>(row);
                entries[row - column] = (i == j ? 1.0 : 0.0) - scale * (there[i] - base[i]);
            }
            moved[j] = y[j];
        }
    }
    check(SUNLinSolSetup(band_solver, band), "SUNLinSolSetup");
}

/// Springs, arcs and the fluid that moves along follow an accepted step with the motion at its end.
void ArkodeStrand::Solver::follow_surroundings(double step) {
    const Surroundings& surroundings = model.surroundings;
    if (surroundings.empty()) return;
    read(N_VGetArrayPointer(vector), time);
    evaluate(false);
    for (std::size_t block = 0; block < work.table.blocks(); ++block) {
        if (!model.features.fluid_mass && !surroundings.changes(wall, block)) continue;
        const auto position = [&](std::size_t node) {
            return node_pose(work, block_start, node).position;
        };
        surroundings.advance_springs(wall, step, block);
        surroundings.refresh_arcs(wall, {block, block + 1}, position);
        if (model.features.fluid_mass)
            surroundings.refresh_fluid_mass(wall, {block, block + 1}, position);
    }
}

ArkodeStrand::ArkodeStrand(const Scene& scene, double tolerance, int order)
    : solver_(std::make_unique<Solver>(scene, tolerance, order)) {}

ArkodeStrand::~ArkodeStrand() = default;

void ArkodeStrand::advance(double end) {
    Solver& s = *solver_;
    double time = 0;
    check(ARKStepGetCurrentTime(s.memory, &time), "ARKStepGetCurrentTime");
    check(ARKStepSetStopTime(s.memory, end), "ARKStepSetStopTime");
    while (time < end) {
        const double before = time;
        const int flag = ARKStepEvolve(s.memory, end, s.vector, &time, ARK_ONE_STEP);
        check(flag, "a step");
        s.time = time;
        s.follow_surroundings(time - before);
        if (flag == ARK_TSTOP_RETURN) break;
    }
}

Profile ArkodeStrand::profile() const {
    const Solver& s = *solver_;
    const double* y = N_VGetArrayPointer(s.vector);
    Profile profile;
    profile.time = s.time;
    std::vector<Vector6> strain;
    for (std::size_t k = 0; k < s.model.segments; ++k) {
        const Vector6 stress = Eigen::Map<const Vector6>(y + stride * k + 6);
        const SectionProperties& section = s.scene.mesh.segment[k];
        profile.stress.push_back(stress);
        strain.emplace_back(stress.cwiseQuotient(stiffness_of(section)) +
                            stress_free_strain(section));
    }
    profile.moment = moments_at_nodes(profile.stress);
    profile.position = positions(
        poses_from_strains(s.string.head.pose(s.head, s.time), s.scene.mesh.length, strain));
    return profile;
}

StepStatistics ArkodeStrand::statistics() const {
    long steps = 0;
    long failures = 0;
    check(ARKStepGetNumSteps(solver_->memory, &steps), "ARKStepGetNumSteps");
    check(ARKStepGetNumErrTestFails(solver_->memory, &failures), "ARKStepGetNumErrTestFails");
    StepStatistics statistics;
    statistics.steps = steps;
    statistics.rejected = failures;
    statistics.evaluations = solver_->evaluations;
    return statistics;
}

}  // namespace drillstrand::bench
