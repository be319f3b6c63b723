#include "rod/director_plain.hpp"

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "forces/implicit_contact.hpp"
#include "forces/surroundings.hpp"
#include "support/annular_flow.hpp"

namespace drillstrand::test {

namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

Vector3d across(const Vector3d& v, const Vector3d& unit) {
    return v - v.dot(unit) * unit;
}

/// Signed area on the unit sphere of the quadrilateral of two directors before and after: the angle
/// by which a vector has turned that was carried around it.
double area_between(const Vector3d& a0, const Vector3d& b0, const Vector3d& b1,
                    const Vector3d& a1) {
    const auto leg = [](const Vector3d& from, const Vector3d& to) {
        return Quaterniond::FromTwoVectors(from, to);
    };
    const Quaterniond around = leg(a1, a0) * leg(b1, a1) * leg(b0, b1) * leg(a0, b0);
    return 2 * std::atan2(around.vec().dot(a0), around.w());
}

/// Force and couples of the segments on one node, before they are divided by its cell.
struct Wrench {
    Vector3d force = Vector3d::Zero();
    Vector3d couple = Vector3d::Zero();  ///< acts across the director
    double torque = 0;                   ///< about the director
};

/// Strains of a segment.
struct Strain {
    Vector3d chord, mean, shear, bend, own;  ///< bend: its own shape in space not yet subtracted
    double stretch;
};

Strain strain_of(const Scene& scene, const PlainRod& rod, std::size_t k) {
    const PlainNode& a = rod.node[k];
    const PlainNode& b = rod.node[k + 1];
    const double h = scene.mesh.length[k];
    Strain s;
    s.chord = (b.position - a.position) / h;
    s.mean = (a.director + b.director).normalized();
    s.stretch = s.chord.dot(s.mean);
    s.shear = s.chord - s.stretch * s.mean;
    const Vector3d normal = a.director.cross(b.director);
    const double angle = std::atan2(normal.norm(), a.director.dot(b.director));
    s.bend = normal.norm() > 0 ? Vector3d(angle / h * normal.normalized()) : Vector3d::Zero();
    const Vector3d& curvature = scene.mesh.segment[k].curvature;
    s.own.setZero();
    for (const PlainNode* n : {&a, &b}) {
        s.own += 0.5 * (curvature[1] * n->material + curvature[2] * n->director.cross(n->material));
    }
    return s;
}

/// Adds a segment's elastic forces to its end nodes.
void add_elastic(const Scene& scene, const PlainRod& rod, std::size_t k, Wrench& on_a,
                 Wrench& on_b) {
    const PlainNode& a = rod.node[k];
    const PlainNode& b = rod.node[k + 1];
    const SectionProperties& section = scene.mesh.segment[k];
    const double h = scene.mesh.length[k];
    const Strain strain = strain_of(scene, rod, k);

    const Vector3d n = section.axial_stiffness * (strain.stretch - 1) * strain.mean +
                       section.shear_stiffness * strain.shear;
    on_a.force += n;
    on_b.force -= n;
    // energy h/2 (EA (g-1)^2 + kGA (D^2 - g^2)) as a function of the mean director
    const Matrix3d change_of_mean = (Matrix3d::Identity() - strain.mean * strain.mean.transpose()) /
                                    (a.director + b.director).norm();
    const Vector3d pull_on_mean = h *
                                  (section.shear_stiffness * strain.stretch -
                                   section.axial_stiffness * (strain.stretch - 1)) *
                                  strain.chord;
    on_a.couple += a.director.cross(change_of_mean * pull_on_mean);
    on_b.couple += b.director.cross(change_of_mean * pull_on_mean);

    const double twist = rod.twist[k] - section.curvature[0];
    const double torque = section.torsional_stiffness * twist;
    const Vector3d axis = (a.director + b.director) / (1 + a.director.dot(b.director));
    on_a.couple += torque * axis;
    on_b.couple -= torque * axis;
    on_a.torque += torque;
    on_b.torque -= torque;

    // h m . (bend - own), m = EI (bend - own), as the directors turn by a small vector each;
    // bend = f(c) a / h, c = cos b, f = b / sin b
    const Vector3d moment = section.bending_stiffness * (strain.bend - strain.own);
    const Vector3d normal = a.director.cross(b.director);
    const double cosine = a.director.dot(b.director);
    const double angle = std::atan2(normal.norm(), cosine);
    // series of f and b cot b where the difference loses digits
    const double b2 = angle * angle;
    const bool small = angle < 0.1;
    const double f = small ? 1 + b2 / 6 + b2 * b2 * 7 / 360 + std::pow(b2, 3) * 31 / 15120 +
                                 std::pow(b2, 4) * 127 / 604800
                           : angle / std::sin(angle);
    const double cotangent_part =
        small ? -b2 / 3 - b2 * b2 / 45 - std::pow(b2, 3) * 2 / 945 - std::pow(b2, 4) / 4725
              : f * cosine - 1;  // b cot b - 1
    const double df_dc = cotangent_part / normal.squaredNorm();
    const Vector3d along = df_dc * moment.dot(normal) * normal;
    const auto own_of = [&](const PlainNode& node) {
        return Vector3d(section.curvature[1] * node.material +
                        section.curvature[2] * node.director.cross(node.material));
    };
    const Vector3d bending_a =
        h / 2 * own_of(a).cross(moment) - along - f * a.director.cross(b.director.cross(moment));
    const Vector3d bending_b =
        h / 2 * own_of(b).cross(moment) + along - f * b.director.cross(moment.cross(a.director));
    on_a.couple += bending_a;
    on_b.couple += bending_b;
    on_a.torque += bending_a.dot(a.director);
    on_b.torque += bending_b.dot(b.director);
}

/// Kelvin-Voigt damping and D_in, with the rates of strain of the half step before.
void add_internal_damping(const Scene& scene, const PlainRod& rod, std::size_t k, Wrench& on_a,
                          Wrench& on_b) {
    const PlainNode& a = rod.node[k];
    const PlainNode& b = rod.node[k + 1];
    const SectionProperties& section = scene.mesh.segment[k];
    const double h = scene.mesh.length[k];
    const Strain strain = strain_of(scene, rod, k);
    const Vector3d w_a = a.angular_velocity + a.spin * a.director;
    const Vector3d w_b = b.angular_velocity + b.spin * b.director;
    const Vector3d g_rate = (b.velocity - a.velocity) / h - (0.5 * (w_a + w_b)).cross(strain.chord);
    const Vector3d k_rate = (w_b - w_a) / h;
    const Matrix3d onto_mean = strain.mean * strain.mean.transpose();
    const Matrix3d across_mean = Matrix3d::Identity() - onto_mean;

    const double tau = scene.damping.kelvin_voigt;
    const Vector3d n = tau * (section.axial_stiffness * onto_mean * g_rate +
                              section.shear_stiffness * across_mean * g_rate);
    const double twisting = tau * section.torsional_stiffness * k_rate.dot(strain.mean);
    const Vector3d m = tau * section.bending_stiffness * across_mean * k_rate +
                       twisting / (1 + a.director.dot(b.director)) * (a.director + b.director);
    const Vector3d lean = h / 2 * strain.chord.cross(n);
    // D_in acts on the node toward the bit
    const DampingPair& internal = scene.damping.internal;
    const Vector3d slowed = internal.translation * scene.mesh.cell[k + 1] * g_rate;
    const Vector3d stilled = internal.rotation * scene.mesh.cell[k + 1] * k_rate;
    on_a.force += n;
    on_b.force += -n - slowed;
    on_a.couple += m + lean;
    on_b.couple += -m + lean - stilled;
    on_a.torque += twisting;
    on_b.torque += -twisting - stilled.dot(b.director);
}

Vector3d turned(const Vector3d& v, double angle, const Vector3d& axis) {
    return Eigen::AngleAxisd(angle, axis) * v;
}

/// Velocity after forces on a pipe that takes fluid along sideways, from that of the pipe alone.
Vector3d shared_with_fluid(const Vector3d& after, const Vector3d& before, const Vector3d& along,
                           double mass, double fluid) {
    return after - fluid / (mass + fluid) * across(after - before, along);
}

/// Normal force of a wall with restitution `e` on a node that would move toward the axis with
/// `star` after all other forces and came toward the wall with `coming`; `pressed`: by spring and
/// dashpot.
double normal_of_impact(double e, double pressed, double star, double coming, double depth,
                        double kick, double mass, bool came, PlainNode& node) {
    const bool was_sent_back = node.rebounds > 0;
    node.rebounds = 1;
    const double speed = std::min(coming, -star);
    if (came && speed > 0) return mass / kick * (e * speed - star);
    if (came || was_sent_back) {
        // no more than lets it out by 5 % of its depth, and nothing where it comes out by itself
        const double gently = 0.05 * depth / kick;
        const double holding =
            coming > -2 * gently ? std::max(mass / kick * (gently - star), 0.0) : 0.0;
        if (holding < pressed) return holding;
    }
    node.rebounds = 0;
    return pressed;
}

/// Fluid that moves along, contact, friction and drag. Returns the well's direction.
Vector3d surround(const Scene& scene, std::size_t k, double kick, double drift,
                  const PlainNode& last, PlainNode& node, Vector3d& v, Vector3d& v_rod,
                  double& spin, StepAccount& account) {
    const SurroundingsParameters p = surroundings_parameters(scene);
    const Vector3d& position = last.position;
    const WellCrossSection section =
        scene.well->project(position, scene.well->find_arc(position, 0));
    const SectionProperties& properties = scene.mesh.node[k];
    const double pipe = properties.outer_radius;
    const double eccentricity = (section.axis - position).norm();
    const Annulus annulus = {pipe, section.radius, eccentricity};
    Matrix3d frame;  // r, l, t
    frame.col(0) = (section.axis - position).normalized();
    frame.col(1) = section.direction;
    frame.col(2) = frame.col(0).cross(frame.col(1));
    const double mass = properties.mass;
    const double polar = properties.polar_inertia;

    if (scene.features.fluid_mass) {
        const double bore = properties.outer_area - properties.metal_area;
        node.fluid_mass = lateral_fluid(*scene.fluid, annulus, bore);
        v = shared_with_fluid(v, last.velocity, frame.col(1), mass, node.fluid_mass);
        v_rod = shared_with_fluid(v_rod, last.velocity, frame.col(1), mass, node.fluid_mass);
        // v^2 grad M / 2 - v dM/dt, grad M = -slope r
        const double slope = lateral_fluid_slope(*scene.fluid, annulus);
        const Vector3d mean = across(last.velocity + v_rod, frame.col(1)) / 2;
        const Vector3d force =
            -slope * mean.squaredNorm() / 2 * frame.col(0) + slope * mean.dot(frame.col(0)) * mean;
        const double rate = kick * std::abs(slope) / (mass + node.fluid_mass) * mean.norm();
        const Vector3d push = kick / (mass + node.fluid_mass) / (1 + rate) * force;
        v += push;
        v_rod += push;
    }

    const Vector3d before = frame.transpose() * v;
    Vector3d u = before;
    const double sideways = mass + node.fluid_mass;
    const Mobility mobility = {kick / sideways, kick / mass, kick / polar};
    const double depth = eccentricity + pipe - section.radius;
    if (depth > 0) {
        // spring and dashpot at the end of the step
        const double resistance = scene.normal_damping[k] + kick * scene.normal_stiffness[k];
        // what a straight step needs to stay at its distance from the axis
        const double way = std::min(drift * std::abs(u[2]), eccentricity);
        const double circling = std::abs(u[2]) * way /
                                (eccentricity + std::sqrt(eccentricity * eccentricity - way * way));
        double normal = (scene.normal_stiffness[k] * depth - resistance * (u[0] - circling)) /
                        (1 + resistance * kick / sideways);
        if (!scene.contact.tension) normal = std::max(normal, 0.0);
        if (scene.contact.restitution)
            normal = normal_of_impact(*scene.contact.restitution, normal, u[0],
                                      -last.velocity.dot(frame.col(0)), depth, kick, sideways,
                                      last.depth <= 0, node);
        const WellVelocity star = {u[0], u[1], u[2], spin};
        // the contact goes around the wall as the pipe went around the axis
        const double rolled =
            kick * std::abs(last.velocity.dot(frame.col(2))) / eccentricity * section.radius;
        const FrictionStep rub =
            scene.contact.law == FrictionLaw::coulomb
                ? coulomb_step(node.spring, star, normal, depth, rolled, pipe, kick, mobility,
                               p.friction)
                : paper_step(node.spring, star, scene.normal_stiffness[k] * depth, depth, rolled,
                             pipe, kick, mobility, p.friction);
        account.impacts += node.depth <= 0 ? 1 : 0;
        account.slips += rub.spring.sliding > node.spring.sliding ? 1 : 0;
        node.spring = rub.spring;
        u += kick *
             Vector3d(normal / sideways, rub.force.axial / mass, rub.force.azimuthal / sideways);
        spin += kick / polar * pipe * rub.force.azimuthal;
    } else {
        node.spring = {};
        node.rebounds = 0;
    }
    if (scene.features.drag) {
        const Eigen::Matrix4d drag =
            textbook_drag(*scene.fluid, annulus, {std::hypot(u[0], u[2]), u[1], spin});
        const Eigen::Vector4d inertia(sideways, mass, sideways, polar);
        const Eigen::Matrix4d system = Eigen::Matrix4d(inertia.asDiagonal()) + kick * drag;
        const Eigen::Vector4d momentum =
            inertia.cwiseProduct(Eigen::Vector4d(u[0], u[1], u[2], spin));
        const Eigen::Vector4d after = system.llt().solve(momentum);
        u = after.head<3>();
        spin = after[3];
    }
    node.depth = depth;
    v += frame * (u - before);
    return frame.col(1);
}

}  // namespace

StepAccount plain_director_step(const Scene& scene, PlainRod& rod, const EndLoad& head,
                                const EndLoad& bit, double drift_before, double kick,
                                double drift) {
    const std::size_t nodes = rod.node.size();
    for (std::size_t k = 0; k + 1 < nodes; ++k) {
        const PlainNode& a = rod.node[k];
        const PlainNode& b = rod.node[k + 1];
        rod.twist[k] += (drift_before * (b.spin - a.spin) +
                         area_between(a.last_director, b.last_director, b.director, a.director)) /
                        scene.mesh.length[k];
    }
    std::vector<Wrench> elastic(nodes);
    std::vector<Wrench> damping(nodes);
    for (std::size_t k = 0; k + 1 < nodes; ++k) {
        add_elastic(scene, rod, k, elastic[k], elastic[k + 1]);
        add_internal_damping(scene, rod, k, damping[k], damping[k + 1]);
    }
    elastic.front().force -= head.pull;
    elastic.front().couple -= head.couple;
    elastic.front().torque -= head.couple.dot(rod.node.front().director);
    elastic.back().force += bit.pull;
    elastic.back().couple += bit.couple;
    elastic.back().torque += bit.couple.dot(rod.node.back().director);

    StepAccount account;
    for (std::size_t k = 0; k < nodes; ++k) {
        PlainNode& node = rod.node[k];
        const PlainNode before = node;
        const double cell = scene.mesh.cell[k];
        const double mass = scene.mesh.node[k].mass;
        const double polar = scene.mesh.node[k].polar_inertia;
        const double inertia = scene.inertia[k];
        const Vector3d& t = before.director;

        Vector3d v = before.velocity +
                     kick / mass * (elastic[k].force / cell + scene.weight[k] * scene.down);
        double spin = before.spin + kick / polar * elastic[k].torque / cell;
        // I dw/dt = couple + rho Ip s (t x w), the last term the mean of before and after the kick:
        // (1 - b [t x]) w_after = (1 + a [t x]) w_before + kick couple / I
        const auto turning = [&](double rate) {
            Matrix3d product;
            product << 0, -t.z(), t.y(), t.z(), 0, -t.x(), -t.y(), t.x(), 0;
            return Matrix3d(kick / inertia * polar * rate / 2 * product);
        };
        const Vector3d given =
            kick / inertia * across(elastic[k].couple, t) / cell +
            (Matrix3d::Identity() + turning(before.spin)) * before.angular_velocity;
        Vector3d w = (Matrix3d::Identity() - turning(spin)).fullPivLu().solve(given);

        Vector3d v_rod = v;
        const Vector3d w_rod = w;
        const double spin_rod = spin;
        const DampingPair& external = scene.damping.external;
        v = (v + kick / mass * damping[k].force / cell) / (1 + kick / mass * external.translation);
        w = (w + kick / inertia * across(damping[k].couple, t) / cell) /
            (1 + kick / inertia * external.rotation);
        spin = (spin + kick / polar * damping[k].torque / cell) /
               (1 + kick / polar * external.rotation);
        Vector3d along = t;
        if (scene.features.well)
            along = surround(scene, k, kick, drift, before, node, v, v_rod, spin, account);
        const Vector3d change = v - v_rod;
        const Vector3d mean = (before.velocity + v) / 2;
        account.outflow -=
            cell * (mass * change.dot(mean) +
                    node.fluid_mass * across(change, along).dot(across(mean, along)) +
                    inertia * (w - w_rod).dot(before.angular_velocity + w) / 2 +
                    polar * (spin - spin_rod) * (before.spin + spin) / 2);

        node.velocity = v;
        node.angular_velocity = w;
        node.spin = spin;
        node.last_director = t;
        node.position += drift * v;
        if (w.norm() > 0)
            node.director = turned(t, 2 * std::atan(drift * w.norm() / 2), w.normalized());
        const Vector3d carried = Quaterniond::FromTwoVectors(t, node.director) * before.material;
        node.material = turned(carried, drift * spin, node.director);
    }
    return account;
}

double plain_elastic_energy(const Scene& scene, const PlainRod& rod) {
    double sum = 0;
    for (std::size_t k = 0; k + 1 < rod.node.size(); ++k) {
        const SectionProperties& s = scene.mesh.segment[k];
        const Strain strain = strain_of(scene, rod, k);
        const double twist = rod.twist[k] - s.curvature[0];
        sum += scene.mesh.length[k] / 2 *
               (s.axial_stiffness * std::pow(strain.stretch - 1, 2) +
                s.shear_stiffness * strain.shear.squaredNorm() +
                s.bending_stiffness * (strain.bend - strain.own).squaredNorm() +
                s.torsional_stiffness * twist * twist);
    }
    return sum;
}

}  // namespace drillstrand::test
