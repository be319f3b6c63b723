#include "rod/director_plain.hpp"

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unsupported/Eigen/AutoDiff>

#include "drillstrand/hydraulics.hpp"
#include "forces/implicit_contact.hpp"
#include "forces/surroundings.hpp"
#include "support/annular_flow.hpp"
#include "support/plain_wall.hpp"

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

// The energy of a segment in numbers that carry their derivatives: forces are its gradient by the
// displacements and the rotations of both nodes.
using Gradient = Eigen::Matrix<double, 12, 1>;  // x_a, w_a, x_b, w_b
using Number = Eigen::AutoDiffScalar<Gradient>;
using Vector = Eigen::Matrix<Number, 3, 1>;

/// Half the angle function of the beam-column, sqrt(y) coth sqrt(y); its derivative follows from
/// its differential equation, 2 y X' = X + y - X^2.
Number cotangent_ratio(const Number& y) {
    const double v = y.value();
    double value = 0;
    double slope = 0;
    if (std::abs(v) < 0.05) {
        constexpr std::array series{
            1.,           1. / 3, -1. / 45, 2. / 945, -1. / 4725., 2. / 93555., -1382. / 638512875.,
            4. / 18243225};
        for (std::size_t n = series.size(); n-- > 0;) {
            slope = slope * v + static_cast<double>(n + 1 < series.size() ? n + 1 : 0) *
                                    (n + 1 < series.size() ? series[n + 1] : 0);
            value = value * v + series[n];
        }
    } else {
        const double root = std::sqrt(std::abs(v));
        value = v > 0 ? root / std::tanh(root) : root / std::tan(root);
        slope = (value + v - value * value) / (2 * v);
    }
    return {value, slope * y.derivatives()};
}

/// The angle between two unit vectors, squared.
Number angle2(const Vector& a, const Vector& b) {
    const Vector normal = a.cross(b);
    const double sine = std::sqrt(normal.squaredNorm().value());
    const double cosine = a.dot(b).value();
    const double angle = std::atan2(sine, cosine);
    const double ratio = sine > 1e-7 ? angle / sine : 1;
    return {angle * angle, -2 * ratio * a.dot(b).derivatives()};
}

Vector moved(const Vector3d& position, Eigen::Index first) {
    Vector x;
    for (Eigen::Index i = 0; i < 3; ++i)
        x[i] = Number(position[i], Gradient::Unit(first + i));
    return x;
}

/// A vector that turns with the rotation of its node.
Vector turned_with(const Vector3d& v, Eigen::Index first) {
    Vector turned;
    for (Eigen::Index i = 0; i < 3; ++i) {
        Gradient slope = Gradient::Zero();
        slope.segment<3>(first) = v.cross(Vector3d::Unit(i));
        turned[i] = Number(v[i], slope);
    }
    return turned;
}

/// Energy of a segment, engine/rod/README.md, "Segment".
Number energy_of(const Scene& scene, const PlainRod& rod, std::size_t k) {
    const PlainNode& a = rod.node[k];
    const PlainNode& b = rod.node[k + 1];
    const SectionProperties& section = scene.mesh.segment[k];
    const double h = scene.mesh.length[k];
    const double ea = section.axial_stiffness;
    const double ei = section.bending_stiffness;
    const double share = 1 / (1 + 12 * ei / (section.shear_stiffness * h * h));

    const Vector chord = (moved(b.position, 6) - moved(a.position, 0)) / Number(h);
    const Vector ta = turned_with(a.director, 3);
    const Vector tb = turned_with(b.director, 9);
    const Number c = sqrt(chord.squaredNorm());
    const Vector e = chord / c;
    const Vector sum = ta + tb;
    const Vector mean = sum / sqrt(sum.squaredNorm());
    const Vector off = e - mean;
    const Number phi2 = off.squaredNorm();  // 2 (1 - e.m)
    const Number b2 = angle2(ta, tb);

    // the load at which the arc carries its strain: z + g z/(30 + z)
    const double slenderness = ea * h * h / ei;
    const Number free = slenderness * (c * (1.0 + b2 / 24.0 + phi2 / 10.0) - 1.0);
    const Number bow = slenderness * (b2 / 24.0 + 3 * share * phi2 / 70.0);
    const Number excess = free - 30.0 - bow;
    const Number z = (excess + sqrt(excess * excess + 120.0 * free)) / 2.0;
    const Number x = cotangent_ratio(z / 4.0);
    const Number symmetric = x - z / 12.0;
    // Y = y / (3 (X - 1)); where y is nothing, 1
    const Number y = z / 4.0;
    const Number slow = std::abs(y.value()) > 1e-3 ? Number(y / (3.0 * (x - 1.0)))
                                                   : Number(1.0 + y / 15.0 - y * y / 525.0);
    const Number antisymmetric = slow - z / 60.0;

    Vector bend = ta.cross(tb);
    const double sine2 = bend.squaredNorm().value();
    const Number ratio =
        sine2 > 1e-14 ? Number(sqrt(b2 / bend.squaredNorm())) : Number(1.0 + b2 / 6.0);
    bend *= ratio / h;
    const Vector3d& own = section.curvature;
    const auto own_of = [&](const PlainNode& node, Eigen::Index first) {
        return Vector(Number(own[1]) * turned_with(node.material, first) +
                      Number(own[2]) * turned_with(node.director.cross(node.material), first));
    };
    const Vector3d axis = (a.director + b.director) / (1 + a.director.dot(b.director));
    Gradient by_rotation = Gradient::Zero();
    by_rotation.segment<3>(3) = -axis / h;
    by_rotation.segment<3>(9) = axis / h;
    const Number frame_twist(rod.twist[k], by_rotation);

    // what the own curvature, turning with the sections, adds
    const Vector own_a = own_of(a, 3);
    const Vector own_b = own_of(b, 9);
    const Number theta = frame_twist * h;
    const Vector own_aside = mean.cross(Vector(own_b - own_a));
    const Number own_twisting = (own_a.dot(tb) - own_b.dot(ta)) / 2.0;
    const double own2 = own[1] * own[1] + own[2] * own[2];
    const Number own_energy =
        ei * (h / 2 * own2 * (1.0 - (1 - share) * theta * theta / 12.0) -
              h * (1.0 + theta * theta / 12.0) * bend.dot(own_a + own_b) / 2.0 -
              share * e.dot(own_aside)) -
        ei * ei * h / (24 * section.torsional_stiffness) * own_twisting * own_twisting;

    // twist of the frames and of the cubic between the nodes
    const Number twist = frame_twist - own[0] + share / h * e.dot(ta.cross(tb)) +
                         (1 - share) / 12 * own_aside.dot(ta.cross(tb));

    // a torque shears a bent segment
    const Number compliance =
        1 / section.torsional_stiffness +
        ta.cross(tb).squaredNorm() / (h * h * section.shear_stiffness + 12 * ei);
    return own_energy + h * (ei / (h * h) *
                                 ((z * free - z * z / 2.0) / slenderness + symmetric * b2 / 2.0 +
                                  6 * share * antisymmetric * phi2) +
                             twist * twist / compliance / 2.0);
}

/// Adds a segment's elastic forces to its end nodes.
void add_elastic(const Scene& scene, const PlainRod& rod, std::size_t k, Wrench& on_a,
                 Wrench& on_b) {
    const Gradient force = -energy_of(scene, rod, k).derivatives();
    on_a.force += force.segment<3>(0);
    on_a.couple += force.segment<3>(3);
    on_a.torque += force.segment<3>(3).dot(rod.node[k].director);
    on_b.force += force.segment<3>(6);
    on_b.couple += force.segment<3>(9);
    on_b.torque += force.segment<3>(9).dot(rod.node[k + 1].director);
}

/// Kelvin-Voigt damping and D_in, with the rates of strain of the half step before.
void add_internal_damping(const Scene& scene, const PlainRod& rod, std::size_t k, Wrench& on_a,
                          Wrench& on_b) {
    const PlainNode& a = rod.node[k];
    const PlainNode& b = rod.node[k + 1];
    const SectionProperties& section = scene.mesh.segment[k];
    const double h = scene.mesh.length[k];
    const Vector3d chord = (b.position - a.position) / h;
    const Vector3d e = chord.normalized();
    const Vector3d mean = (a.director + b.director).normalized();
    const Vector3d w_a = a.angular_velocity + a.spin * a.director;
    const Vector3d w_b = b.angular_velocity + b.spin * b.director;
    const Vector3d g_rate = (b.velocity - a.velocity) / h - (0.5 * (w_a + w_b)).cross(chord);
    const Vector3d turn_rate = w_b - w_a;

    // rates of c, of the angle between the directors and of the chord's deviation from their mean
    const double tau = scene.damping.kelvin_voigt;
    const Vector3d normal = a.director.cross(b.director);
    const double angle = std::atan2(normal.norm(), a.director.dot(b.director));
    const Vector3d bend = (normal.norm() > 1e-9 ? angle / normal.norm() : 1) * normal;
    const double phi2 = (e - mean).squaredNorm();
    const Vector3d deviation = across(e, mean);
    const double stretching = 1 + angle * angle / 24 + phi2 / 10;
    const double strain_rate = stretching * g_rate.dot(e) + across(deviation, e).dot(g_rate) / 5 +
                               chord.norm() * bend.dot(turn_rate) / 12;
    const double share =
        1 / (1 + 12 * section.bending_stiffness / (section.shear_stiffness * h * h));
    const double tension = tau * section.axial_stiffness * strain_rate;
    const double shearing = tau * 12 * share * section.bending_stiffness / (h * h);
    const Vector3d n =
        tension * (stretching * e + across(deviation, e) / 5) + shearing * across(g_rate, e);
    const double twisting = tau * section.torsional_stiffness / h * turn_rate.dot(mean);
    const Vector3d m = tau * section.bending_stiffness / h * across(turn_rate, mean) +
                       tension * chord.norm() * h / 12 * bend +
                       twisting / (1 + a.director.dot(b.director)) * (a.director + b.director);
    const Vector3d lean = h / 2 * chord.cross(n);
    // D_in acts on the node toward the bit
    const DampingPair& internal = scene.damping.internal;
    const Vector3d slowed = internal.translation * scene.mesh.cell[k + 1] * g_rate;
    const Vector3d stilled = internal.rotation * scene.mesh.cell[k + 1] * turn_rate / h;
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

/// The wall's spring where a node is: its force (N/m), what it adds against the speed toward the
/// axis (Pa s), its energy (J/m).
struct PlainSpring {
    double force, resistance, energy;
};

/// `stiffness` of a wall of firmness 1; `inertia` of the node on the way that the wall leans.
PlainSpring plain_spring(const Scene& scene, const PlainWall& wall, double stiffness, double depth,
                         double kick, double inertia) {
    const double firm = wall.firmness * stiffness;
    if (scene.contact.normal_law == NormalLaw::linear)
        return {firm * depth, kick * firm, firm * depth * depth / 2};
    const double force = firm * std::pow(depth, 1.5);
    const double tangent = 1.5 * firm * std::sqrt(depth);
    const double swing = tangent * kick * kick / inertia;
    const double resistance =
        scene.contact.hunt_crossley * force + swing / (2 + swing) * kick * tangent;
    return {force, resistance, 0.4 * firm * std::pow(depth, 2.5)};
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

/// Friction of a surface that slips at a speed.
FrictionParameters plain_friction(const ContactCase& contact, double slip) {
    const auto at_slip = [&](double fixed, double slide) {
        return slide + (fixed - slide) / (1 + std::pow(slip / contact.stribeck_speed, 2));
    };
    FrictionCoefficients fixed = contact.static_friction;
    FrictionCoefficients slide = contact.dynamic_friction;
    if (contact.stribeck_speed > 0) {
        slide = {at_slip(fixed.axial, slide.axial), at_slip(fixed.azimuthal, slide.azimuthal)};
        fixed = slide;
    }
    return friction_parameters(contact.tangential_stiffness, {fixed.axial, fixed.azimuthal},
                               {slide.axial, slide.azimuthal}, contact.law, contact.rolling_creep);
}

/// Fluid that moves along, contact, friction and drag. Returns the well's direction.
Vector3d surround(const Scene& scene, std::size_t k, double kick, double drift,
                  const PlainNode& last, PlainNode& node, Vector3d& v, Vector3d& v_rod,
                  double& spin, StepAccount& account) {
    const Vector3d& position = last.position;
    const PlainWall wall = plain_wall(scene, position);
    const WellCrossSection& section = wall.section;
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
    // external damping makes the node as much heavier as it takes of what walls and mud give
    const DampingPair& external = scene.damping.external;
    const double along = mass + kick * external.translation;
    const double sideways = (mass + node.fluid_mass) * along / mass;
    const double turning = polar + kick * external.rotation;
    const Mobility mobility = {kick / sideways, kick / along, kick / turning};
    const double depth = eccentricity + pipe - section.radius;
    if (depth > 0) {
        // spring and dashpot at the end of the step, on the way that the wall leans
        const ContactCase contact = contact_at(scene, wall);
        const FrictionParameters friction =
            plain_friction(contact, std::hypot(last.velocity.dot(frame.col(1)),
                                               last.velocity.dot(frame.col(2)) + pipe * last.spin));
        const double inertia = 1 / (1 / sideways + wall.lean * wall.lean / along);
        const PlainSpring spring =
            plain_spring(scene, wall, scene.normal_stiffness[k], depth, kick, inertia);
        const double resistance = wall.damping * scene.normal_damping[k] + spring.resistance;
        const double inward = u[0] + wall.lean * u[1];
        const double softer = -spring.energy * wall.firming / wall.firmness;
        // what a straight step needs to stay at its distance from the axis
        const double way = std::min(drift * std::abs(u[2]), eccentricity);
        const double circling = std::abs(u[2]) * way /
                                (eccentricity + std::sqrt(eccentricity * eccentricity - way * way));
        double normal =
            (spring.force - resistance * (inward - circling)) / (1 + resistance * kick / inertia);
        if (!scene.contact.tension) normal = std::max(normal, 0.0);
        if (scene.contact.restitution)
            normal = normal_of_impact(*scene.contact.restitution, normal,
                                      inward + wall.lean * kick / along * softer,
                                      -last.velocity.dot(frame.col(0) + wall.lean * frame.col(1)),
                                      depth, kick, inertia, last.depth <= 0, node);
        u += kick * Vector3d(normal / sideways, (wall.lean * normal + softer) / along, 0);
        const WellVelocity star = {u[0], u[1], u[2], spin};
        // the contact goes around the wall as the pipe went around the axis
        const double rolled =
            kick * std::abs(last.velocity.dot(frame.col(2))) / eccentricity * section.radius;
        const FrictionStep rub = scene.contact.law == FrictionLaw::coulomb
                                     ? coulomb_step(node.spring, star, normal, depth, rolled, pipe,
                                                    kick, mobility, friction)
                                     : paper_step(node.spring, star, spring.force, depth, rolled,
                                                  pipe, kick, mobility, friction);
        account.impacts += node.depth <= 0 ? 1 : 0;
        account.slips += rub.spring.sliding > node.spring.sliding ? 1 : 0;
        node.spring = rub.spring;
        u += kick * Vector3d(0, rub.force.axial / along, rub.force.azimuthal / sideways);
        spin += kick / turning * pipe * rub.force.azimuthal;
    } else {
        node.spring = {};
        node.rebounds = 0;
    }
    if (scene.features.drag) {
        Stirring stirring;
        if (scene.features.flowing_mud) {
            const Hydraulics flow = hydraulics_of(scene, mud_motion(scene));
            stirring.pumped = flow.annulus_speed[k];
            stirring.pumped_shear = flow.annulus_shear[k];
            u[1] += kick / along * flow.axial_load[k];
        }
        stirring.across = std::hypot(u[0], u[2]);
        stirring.along = u[1];
        stirring.spin = spin;
        stirring.around = u[2];
        const Eigen::Matrix4d drag = textbook_drag(*scene.fluid, annulus, stirring);
        const Eigen::Vector4d inertia(sideways, along, sideways, turning);
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

        const Vector3d centrifugal =
            scene.mesh.unbalance.empty()
                ? Vector3d::Zero()
                : Vector3d(scene.mesh.unbalance[k] * before.spin * before.spin * before.material);
        Vector3d v =
            before.velocity +
            kick / mass * ((elastic[k].force + centrifugal) / cell + scene.weight[k] * scene.down);
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
        account.outflow -= kick * centrifugal.dot(mean);
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
    for (std::size_t k = 0; k + 1 < rod.node.size(); ++k)
        sum += energy_of(scene, rod, k).value();
    return sum;
}

}  // namespace drillstrand::test
