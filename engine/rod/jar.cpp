#include "rod/jar.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "model/segment_strain.hpp"
#include "rod/director_rows.hpp"

namespace drillstrand {

namespace {

/// Where a node is, and its director.
struct NodePose {
    Triple place, director;
};

NodePose pose_at(const NodesIn& node) {
    return {node.x[0], node.t[0]};
}
/// At the whole step before, `drift` (s) ago.
NodePose last_pose_at(const NodesIn& node, double drift) {
    return {combine(1.0, node.x[0], -drift, node.v[0]), node.last_t[0]};
}

/// A segment of the rod whose halves can be apart.
struct SlidingSegment {
    SlidingSegment(const SegmentConstants& c, const NodePose& a, const NodePose& b)
        : stiffness(c.stiffness[0]),
          length(c.length[0]),
          inverse_length(c.inverse_length[0]),
          first(a.director),
          last(b.director),
          arc(first, last),
          factor(arc.factor()),
          chord(a.place, b.place, inverse_length, first, last, arc.inverse_both()) {}

    [[nodiscard]] BeamColumn column(double slide) const {
        return {stiffness, chord, factor * factor * dot(arc.turn, arc.turn),
                slide * inverse_length};
    }
    /// By how much its arc is longer than the segment (m): of a slide, what leaves it slack.
    [[nodiscard]] double elongation() const { return length * column(0).strain; }
    SegmentStiffness stiffness;
    double length;
    double inverse_length;
    Triple first, last;  ///< directors
    SegmentBend arc;
    double factor;
    SegmentChord chord;
};

/// Takes from viscous forces and drag what the rate of an elongation without strain makes of them:
/// of the viscous pull all that is along the chord belongs to that rate.
void slacken_damping(const SlidingSegment& segment, double stretching, Damping damping,
                     const SegmentsOut& out) {
    if (damping == Damping::none) return;
    const Triple& e = segment.chord.along;
    out.drag_force.set(0, without(at(out.drag_force, 0), e));
    if (damping != Damping::kelvin_voigt) return;
    const StrainGrowth growth(segment.chord, stretching, segment.factor);
    const Triple pull = at(out.viscous_pull, 0);
    const double slack = dot(pull, e) / dot(growth.by_chord, e);
    const Triple left = combine(1.0, pull, -slack, growth.by_chord);
    out.viscous_pull.set(0, left);
    out.viscous_lean.set(0, scaled(0.5 * segment.length * segment.chord.ratio, cross(e, left)));
    out.viscous_couple.set(0, combine(1.0, at(out.viscous_couple, 0),
                                      -segment.length * slack * growth.by_bend, segment.arc.turn));
}

void add(const Triples& rows, const Triple& change) {
    rows.set(0, combine(1.0, at(rows, 0), 1.0, change));
}

}  // namespace

Jar::Jar(const StringMesh& mesh) : jar_(mesh.jar) {
    if (jar_) length_ = mesh.length[jar_->segment];
}

double Jar::way_of(double tension) const {
    const JarCase& law = jar_->law;
    if (law.up_force > 0 && tension > law.up_force) return 1;
    if (law.down_force > 0 && -tension > law.down_force) return -1;
    return 0;
}

void Jar::meter(JarState& jar, double tension, double drift) const {
    const double way = way_of(tension);
    jar.overpulled = way * (std::max(way * jar.overpulled, 0.0) + drift);
    if (way == 0 || std::abs(jar.overpulled) < jar_->law.delay) return;
    jar.released = 1;
    jar.overpulled = 0;
}

void Jar::slide_to(JarState& jar, double place) const {
    if (place * jar.slide <= 0) {
        jar.released = 0;
        jar.slide = 0;
        return;
    }
    const bool was_free = is_free(jar);
    jar.slide = place;
    if (was_free && !is_free(jar)) jar.blows += 1;
}

JarState Jar::follow(JarState jar, const DirectorModel& model, const Table<DirectorRow>& rod,
                     double drift) const {
    if (!jar_) return jar;
    const auto number = static_cast<std::ptrdiff_t>(jar_->segment);
    const SegmentConstants constants(model.constants, number);
    const NodesIn a(rod, number);
    const NodesIn b(rod, number + 1);
    const SlidingSegment segment(constants, pose_at(a), pose_at(b));
    const double place =
        std::clamp(segment.elongation(), -jar_->law.down_travel, jar_->law.up_travel);
    const double last_slide = jar.slide;
    if (jar.released == 0) {
        meter(jar, segment.column(0).tension, drift);
        if (jar.released != 0) jar.slide = place;
    } else {
        slide_to(jar, place);
    }
    if (jar.slide == last_slide) return jar;
    const SlidingSegment before(constants, last_pose_at(a, drift), last_pose_at(b, drift));
    jar.work += 0.5 * (before.column(last_slide).tension + segment.column(jar.slide).tension) *
                (jar.slide - last_slide);
    return jar;
}

void Jar::slacken(const JarState& jar, const DirectorModel& model, const Table<DirectorRow>& rod,
                  Table<SegmentRow>& segments) const {
    if (!jar_ || jar.slide == 0) return;
    const auto number = static_cast<std::ptrdiff_t>(jar_->segment);
    const SlidingSegment segment(SegmentConstants(model.constants, number),
                                 pose_at(NodesIn(rod, number)), pose_at(NodesIn(rod, number + 1)));
    const ColumnForces whole = segment.column(0).forces();
    const ColumnForces slid = segment.column(jar.slide).forces();
    const ColumnForces change{whole.stretching, slid.tension - whole.tension,
                              slid.moment - whole.moment, slid.shearing - whole.shearing};
    const SegmentsOut out(segments, number);
    const Triple pull = change.pull(segment.chord);
    const double bending = segment.length * change.moment * segment.factor;
    const Triple both = scaled(segment.length * change.shearing * segment.arc.inverse_both(),
                               segment.chord.deviation);
    add(out.pull, pull);
    add(out.last_pull, pull);
    add(out.first_lean, combine(bending, segment.last, 1.0, both));
    add(out.last_lean, combine(bending, segment.first, 1.0, both));
    if (is_free(jar)) slacken_damping(segment, whole.stretching, model.features.damping, out);
}

std::array<double, block_size> Jar::slid_in(const JarState& jar, std::size_t block) const {
    std::array<double, block_size> slide{};
    if (is_in({block, block + 1})) slide[jar_->segment % block_size] = jar.slide / length_;
    return slide;
}

void Jar::check(const JarState& jar) const {
    const bool is_count = jar.blows >= 0 && jar.blows <= largest_whole_number;
    const bool is_in_reach =
        !jar_ || (jar.slide >= -jar_->law.down_travel && jar.slide <= jar_->law.up_travel);
    if (!is_count || !is_in_reach)
        throw std::invalid_argument("the jar of the saved state is out of order");
}

}  // namespace drillstrand
