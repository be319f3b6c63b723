#include <Eigen/Core>
#include <cstdint>
#include <type_traits>

#include "drillstrand/result_layout.hpp"
#include "drillstrand/well.hpp"

namespace drillstrand {

namespace {

/// How a value of type T appears in a dataset.
template <class T>
struct Stored {
    static_assert(std::is_same_v<T, double> || std::is_same_v<T, std::int64_t>);
    static constexpr std::size_t components = 1;
    static constexpr bool integer = std::is_integral_v<T>;
    static void append(const T& value, std::vector<double>& out) {
        out.push_back(static_cast<double>(value));
    }
    static void assign(T& value, const double* in) { value = static_cast<T>(*in); }
};

template <int size>
struct Stored<Eigen::Matrix<double, size, 1>> {
    using Vector = Eigen::Matrix<double, size, 1>;
    static constexpr std::size_t components = size;
    static constexpr bool integer = false;
    static void append(const Vector& value, std::vector<double>& out) {
        out.insert(out.end(), value.begin(), value.end());
    }
    static void assign(Vector& value, const double* in) { value = Eigen::Map<const Vector>(in); }
};

/// Dataset of the member reached through the chain of member pointers, one value per record.
template <class Record, auto... members>
RecordDataset<Record> value(const std::string& path, const char* units, const char* description) {
    using Value = std::remove_cvref_t<decltype((std::declval<Record&>().*....*members))>;
    return {path,
            Rows::one,
            Stored<Value>::components,
            Stored<Value>::integer,
            units,
            description,
            [](const Record& record, std::vector<double>& out) {
                Stored<Value>::append((record.*....*members), out);
            },
            [](Record& record, const double* in, std::size_t) {
                Stored<Value>::assign((record.*....*members), in);
            }};
}

template <auto... members>
RecordDataset<SeriesRecord> series(const char* path, const char* units, const char* description) {
    return value<SeriesRecord, members...>(path, units, description);
}

/// Dataset of a member that is a vector with one value per node or segment.
template <class Record, auto member>
RecordDataset<Record> values(const char* path, Rows rows, const char* units,
                             const char* description) {
    using Value =
        typename std::remove_cvref_t<decltype(std::declval<Record&>().*member)>::value_type;
    return {path,
            rows,
            Stored<Value>::components,
            Stored<Value>::integer,
            units,
            description,
            [](const Record& record, std::vector<double>& out) {
                for (const Value& row : record.*member)
                    Stored<Value>::append(row, out);
            },
            [](Record& record, const double* in, std::size_t count) {
                (record.*member).resize(count);
                for (Value& row : record.*member) {
                    Stored<Value>::assign(row, in);
                    in += Stored<Value>::components;
                }
            }};
}

template <auto member>
RecordDataset<Profile> profile(const char* path, Rows rows, const char* units,
                               const char* description) {
    return values<Profile, member>(path, rows, units, description);
}

constexpr const char* stress_units = "N m, N m, N m, N, N, N";

}  // namespace

const std::vector<RecordDataset<ResultHeader>>& mesh_datasets() {
    static const std::vector<RecordDataset<ResultHeader>> table = {
        values<ResultHeader, &ResultHeader::node_s>("/mesh/node_s", Rows::nodes, "m",
                                                    "arc length of the nodes from the head, along "
                                                    "the unstressed rod"),
        values<ResultHeader, &ResultHeader::segment_s>("/mesh/segment_s", Rows::segments, "m",
                                                       "arc length of the middles of the segments "
                                                       "from the head, along the unstressed rod"),
    };
    return table;
}

const std::vector<RecordDataset<ResultHeader>>& string_datasets() {
    using H = ResultHeader;
    static const std::vector<RecordDataset<H>> table = {
        values<H, &H::cell>("/string/cell", Rows::nodes, "m",
                            "length of string whose mass and loads the node carries"),
        values<H, &H::mass>("/string/mass", Rows::nodes, "kg/m", "mass per length"),
        values<H, &H::weight>("/string/weight", Rows::nodes, "N/m",
                              "weight per length, less that of the fluid displaced"),
        values<H, &H::outer_radius>("/string/outer_radius", Rows::nodes, "m",
                                    "outer radius of the pipe"),
        values<H, &H::polar_inertia>("/string/polar_inertia", Rows::nodes, "kg m",
                                     "moment of inertia per length about the axis: angular "
                                     "momentum about d3 divided by the rate of rotation"),
        values<H, &H::metal_area>("/string/metal_area", Rows::segments, "m2",
                                  "area of the metal in the cross section"),
        values<H, &H::yield_tension>("/string/yield_tension", Rows::segments, "N",
                                     "axial force that alone brings the weakest pipe of the "
                                     "segment to yield, infinite where unknown"),
        values<H, &H::yield_bending>("/string/yield_bending", Rows::segments, "N m",
                                     "bending moment that alone brings it to yield"),
        values<H, &H::yield_torque>("/string/yield_torque", Rows::segments, "N m",
                                    "torque that alone brings it to yield"),
    };
    return table;
}

const std::vector<RecordDataset<SeriesRecord>>& series_datasets() {
    using R = SeriesRecord;
    using E = EnergyAccount;
    using W = Whirl;
    static const std::vector<RecordDataset<SeriesRecord>> table = {
        series<&R::time>("/series/time", "s", "time since the start of the run"),
        series<&R::head_stress>("/series/head_stress", stress_units,
                                "stress of the first segment: twist moment, bending 1, bending 2, "
                                "axial force, shear 1, shear 2"),
        series<&R::bit_stress>("/series/bit_stress", stress_units,
                               "stress of the last segment: twist moment, bending 1, bending 2, "
                               "axial force, shear 1, shear 2"),
        series<&R::head_position>("/series/head_position", "m",
                                  "position of the first node: north, east, down"),
        series<&R::bit_position>("/series/bit_position", "m",
                                 "position of the last node: north, east, down"),
        series<&R::head_rotation_rate>("/series/head_rotation_rate", "rad/s",
                                       "rotation rate of the first node about d3"),
        series<&R::bit_rotation_rate>("/series/bit_rotation_rate", "rad/s",
                                      "rotation rate of the last node about d3"),
        series<&R::hook_load>("/series/hook_load", "N",
                              "force along the well that holds the head: the pull of the first "
                              "segment and the buoyed weight of the head's own half cell"),
        series<&R::dead_line_tension>("/series/dead_line_tension", "N",
                                      "tension of one line of the hoist, which its dead line "
                                      "shows; 0 without a hoist"),
        series<&R::surface_torque>("/series/surface_torque", "N m",
                                   "couple about d3 of the drive on the head, positive where it "
                                   "drives a positive rotation"),
        series<&R::drive_torque>("/series/drive_torque", "N m",
                                 "torque of the top drive's motor, that which turns its own "
                                 "inertia included; without a drive the surface torque"),
        series<&R::weight_on_bit>("/series/weight_on_bit", "N",
                                  "compressive force of the rock on the bit"),
        series<&R::bit_torque>("/series/bit_torque", "N m",
                               "torque of the rock on the bit, positive against a positive "
                               "rotation"),
        series<&R::depth_of_cut>("/series/depth_of_cut", "m",
                                 "depth that the bit cuts in a turn; 0 where bit.law is not "
                                 "\"cutting\""),
        series<&R::drilled>("/series/drilled", "m",
                            "depth of the bit below the bottom of the hole at the start, negative "
                            "off bottom; 0 where bit.law is not \"cutting\""),
        series<&R::jar_force>("/series/jar_force", "N",
                              "tension in the jar's segment; 0 without a jar"),
        series<&R::jar_travel>("/series/jar_travel", "m",
                               "of the jar's halves apart, from where they latch; negative: "
                               "together"),
        series<&R::jar_blows>("/series/jar_blows", "1",
                              "blows of the jar's hammer since the start"),
        series<&R::energy, &E::kinetic>("/series/kinetic_energy", "J", "kinetic energy"),
        series<&R::energy, &E::rotation>("/series/rotation_energy", "J",
                                         "kinetic energy of the spin about d3, part of the kinetic "
                                         "energy"),
        series<&R::energy, &E::half_steps>("/series/half_step_energy", "J",
                                           "leapfrog: by how much the energy of the half steps "
                                           "before and after the record exceeds "
                                           "the kinetic energy, from the first step on"),
        series<&R::energy, &E::elastic>("/series/elastic_energy", "J",
                                        "strain energy of the rod and of the contact springs"),
        series<&R::energy, &E::springs>("/series/spring_energy", "J",
                                        "energy of the contact springs, part of the strain energy"),
        series<&R::energy, &E::potential>("/series/potential_energy", "J",
                                          "potential energy of the buoyed weight, 0 at the start"),
        series<&R::energy, &E::work>("/series/work", "J",
                                     "work done on the string by the head, the bit and dead loads "
                                     "since the start"),
        series<&R::energy, &E::dissipation>("/series/dissipation", "J",
                                            "energy dissipated in damping, fluid, contact dashpots "
                                            "and friction since the start"),
        series<&R::step_size>("/series/step_size", "s", "length of the last time step"),
        series<&R::time_error>(
            "/series/time_error", "1",
            "time error of the last sample, relative: by how much velocities "
            "and stresses (in the norm of energy) differ after 16 steps from "
            "those of exact time steps, by step doubling; 0 with dormand-prince"),
        series<&R::max_penetration>("/series/max_penetration", "m",
                                    "largest penetration of the pipe into the wall"),
        series<&R::relative_penetration>("/series/relative_penetration", "1",
                                         "largest penetration of a node, divided by the clearance "
                                         "that the pipe has there"),
        series<&R::penetration_depth>("/series/penetration_depth", "m",
                                      "measured depth of the largest penetration, 0 without one"),
        series<&R::helix_penetration>("/series/helix_penetration", "m",
                                      "largest penetration that a helix of a node's compression "
                                      "would have, at most ten clearances"),
        series<&R::wall_drag>("/series/wall_drag", "N",
                              "friction of the wall on the string along the well, positive down "
                              "the well: what it adds to the hook load"),
        series<&R::drag_depth>("/series/drag_depth", "m",
                               "measured depth of the middle of that friction, 0 without any"),
        series<&R::whirl, &W::forward>("/series/whirl_forward", "1",
                                       "share of the string's length in forward whirl"),
        series<&R::whirl, &W::backward>("/series/whirl_backward", "1",
                                        "share of the string's length in backward whirl"),
        series<&R::whirl, &W::rate>("/series/whirl_rate", "rad/s",
                                    "rate around the well's axis, mean of what whirls, negative "
                                    "against the rotation"),
        series<&R::whirl, &W::rolling_rate>("/series/rolling_rate", "rad/s",
                                            "rate around the well's axis at which what whirls "
                                            "would roll along the wall without slip, mean"),
        series<&R::whirl, &W::depth>("/series/whirl_depth", "m",
                                     "measured depth of the middle of what whirls, 0 where nothing "
                                     "does"),
        series<&R::contact_nodes>("/series/contact_nodes", "1", "number of nodes in contact"),
        series<&R::impacts>("/series/impacts", "1",
                            "nodes that came into contact since the start, counted at the ends of "
                            "time steps; those that start in contact included"),
        series<&R::contact_changes>("/series/contact_changes", "1",
                                    "nodes that came into or left contact since the start"),
        series<&R::slips>("/series/slips", "1",
                          "nodes in contact that began to slide since the start; 0 with the "
                          "paper's friction law"),
    };
    return table;
}

const std::vector<RecordDataset<Profile>>& profile_datasets() {
    using P = Profile;
    static const std::vector<RecordDataset<Profile>> table = {
        value<P, &P::time>("/profiles/time", "s", "time since the start of the run"),
        profile<&P::position>("/profiles/position", Rows::nodes, "m",
                              "position: north, east, down"),
        profile<&P::director>("/profiles/director", Rows::nodes, "1",
                              "d3, the unit normal of the section, head to bit: north, east, down"),
        profile<&P::momentum>("/profiles/momentum", Rows::nodes,
                              "kg m/s, kg m/s, kg m/s, kg/s, kg/s, kg/s",
                              "momentum per length in body axes: angular about d3, d1, d2, linear "
                              "along d3, d1, d2"),
        profile<&P::stress>("/profiles/stress", Rows::segments, stress_units,
                            "stress in body axes: twist moment, bending 1, bending 2, axial force, "
                            "shear 1, shear 2"),
        profile<&P::moment>("/profiles/moment", Rows::nodes, "N m",
                            "moment at the nodes in body axes: twist moment, bending 1, bending 2"),
        profile<&P::eccentricity>("/profiles/eccentricity", Rows::nodes, "m",
                                  "distance from the axis of the well, 0 without a well"),
        profile<&P::well_depth>("/profiles/well_depth", Rows::nodes, "m",
                                "measured depth of the well's section that holds the node, 0 "
                                "without a well"),
        profile<&P::contact_force>("/profiles/contact_force", Rows::nodes, "N/m",
                                   "force of the wall on the pipe per length, normal and friction: "
                                   "north, east, down"),
        profile<&P::normal_force>("/profiles/normal_force", Rows::nodes, "N/m",
                                  "normal force of the wall on the pipe per length, not negative"),
        profile<&P::side_force>("/profiles/side_force", Rows::nodes, "N/m",
                                "normal force of the wall per length, mean over the window "
                                "output.side_force_window around the node"),
        profile<&P::whirl_rate>("/profiles/whirl_rate", Rows::nodes, "rad/s",
                                "rate around the well's axis, negative against the rotation, 0 of "
                                "what does not whirl"),
    };
    return table;
}

std::vector<RecordDataset<SensorRecord>> sensor_datasets(const std::string& name) {
    using S = SensorRecord;
    const std::string path = "/sensors/" + name + '/';
    return {
        value<S, &S::time>(path + "time", "s", "time since the start of the run"),
        value<S, &S::acceleration>(path + "acceleration", "m/s2",
                                   "acceleration less that of gravity, along d3, d1, d2 of the "
                                   "sensor"),
        value<S, &S::rotation_rate>(path + "rotation_rate", "rad/s", "rotation rate about d3"),
        value<S, &S::bending_moment>(path + "bending_moment", "N m",
                                     "bending moment about d1 and d2"),
        value<S, &S::torque>(path + "torque", "N m",
                             "torque, positive where what is above drives a positive rotation"),
        value<S, &S::tension>(path + "tension", "N", "axial force"),
    };
}

const std::vector<RecordDataset<SegmentCycles>>& cycle_datasets() {
    using C = SegmentCycles;
    static const std::vector<RecordDataset<C>> table = {
        values<C, &C::cycles>("/cycles/count", Rows::segments, "1",
                              "cycles of bending stress of the fibre that suffers most damage"),
        values<C, &C::largest_range>("/cycles/largest_range", Rows::segments, "Pa",
                                     "the largest range among them"),
        values<C, &C::equivalent_range>("/cycles/equivalent_range", Rows::segments, "Pa",
                                        "range of which as many cycles do the same damage"),
    };
    return table;
}

namespace {

/// Dataset of one member of the rows that WellCase holds in `list`.
template <auto list, auto member>
WellDataset well_value(const char* path, const char* extent, const char* units,
                       const char* description) {
    return {path,
            extent,
            1,
            units,
            description,
            [](const WellCase& well) {
                std::vector<double> values;
                for (const auto& row : well.*list)
                    values.push_back(row.*member);
                return values;
            },
            [](WellCase& well, const std::vector<double>& values) {
                (well.*list).resize(values.size());
                for (std::size_t k = 0; k < values.size(); ++k)
                    (well.*list)[k].*member = values[k];
            }};
}

std::vector<double> station_coordinates(const WellCase& well) {
    std::vector<double> values;
    for (const Eigen::Vector3d& position : station_positions(well.survey))
        values.insert(values.end(), position.begin(), position.end());
    return values;
}

}  // namespace

const std::vector<WellDataset>& well_datasets() {
    using W = WellCase;
    static const std::vector<WellDataset> table = {
        well_value<&W::survey, &SurveyStation::measured_depth>(
            "/well/measured_depth", "S", "m", "measured depth of the survey's stations"),
        well_value<&W::survey, &SurveyStation::inclination>(
            "/well/inclination", "S", "rad", "angle of the well from the vertical at the stations"),
        well_value<&W::survey, &SurveyStation::azimuth>(
            "/well/azimuth", "S", "rad", "direction of the well, clockwise from north"),
        {"/well/position", "S", 3, "m",
         "position of the stations by minimum curvature: north, east, down", &station_coordinates,
         [](WellCase&, const std::vector<double>&) {}},
        well_value<&W::sections, &WellSectionCase::to>(
            "/well/section_end", "D", "m",
            "measured depth at which a section of one diameter ends; the last one goes on"),
        well_value<&W::sections, &WellSectionCase::diameter>(
            "/well/section_diameter", "D", "m",
            "diameter of the hole in the section, at its start"),
    };
    return table;
}

const std::vector<RecordDataset<BucklingMode>>& buckling_datasets() {
    using M = BucklingMode;
    static const std::vector<RecordDataset<M>> table = {
        value<M, &M::load>("/buckling/critical_load", "N",
                           "dead compressive load at the tip at which the straight string buckles, "
                           "above weight"),
        values<M, &M::strain>(
            "/buckling/mode_strain", Rows::segments, "1/m, 1/m, 1/m, 1, 1, 1",
            "change of strain in the middles of segments, in body axes: twist, bending 1, "
            "bending 2, stretch, shear 1, shear 2; the largest deflection is 1 m"),
    };
    return table;
}

const std::vector<RecordDataset<UnstableMode>>& instability_datasets() {
    using M = UnstableMode;
    static const std::vector<RecordDataset<M>> table = {
        value<M, &M::eigenvalue>("/buckling/instability/eigenvalue", "N m2",
                                 "negative eigenvalue of the Hessian: twice the energy of the "
                                 "shape over the integral of its squared curvature"),
        values<M, &M::strain>("/buckling/instability/strain", Rows::segments,
                              "1/m, 1/m, 1/m, 1, 1, 1", "strain of the shape, as mode_strain"),
    };
    return table;
}

}  // namespace drillstrand
