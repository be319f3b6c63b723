#include <numbers>

#include "drillstrand/modes_file.hpp"
#include "results/dataset_of.hpp"

namespace drillstrand {

namespace {

constexpr const char* kind_text =
    "what most of the kinetic energy is in: 0 lateral, 1 torsional, 2 axial";
constexpr const char* whirl_text =
    "1: nodes go round on circles with the positive rotation, -1: against it, 0: to and fro";

constexpr double turn = 2 * std::numbers::pi;

/// A frequency, in Hz in files and in rad/s beside its equations.
template <class Record>
RecordDataset<Record> frequency(const char* path, const char* description) {
    RecordDataset<Record> dataset = value<Record, &Record::frequency>(path, "Hz", description);
    dataset.append = [](const Record& record, std::vector<double>& out) {
        out.push_back(record.frequency / turn);
    };
    dataset.assign = [](Record& record, const double* in, std::size_t) {
        record.frequency = turn * *in;
    };
    return dataset;
}

}  // namespace

const std::vector<RecordDataset<StaticShape>>& static_shape_datasets() {
    using S = StaticShape;
    static const std::vector<RecordDataset<S>> table = {
        values<S, &S::position>("/modes/static/position", Rows::nodes, "m",
                                "position: north, east, down"),
        values<S, &S::director>("/modes/static/director", Rows::nodes, "1",
                                "unit vector d3 along the string"),
        values<S, &S::side_force>("/modes/static/side_force", Rows::nodes, "N",
                                  "normal force of the wall on the node's cell"),
    };
    return table;
}

const std::vector<RecordDataset<VibrationMode>>& mode_datasets() {
    using M = VibrationMode;
    static const std::vector<RecordDataset<M>> table = {
        frequency<M>("/modes/frequency", "natural frequency"),
        value<M, &M::kind>("/modes/kind", "1", kind_text),
        value<M, &M::lateral_share>("/modes/lateral_share", "1",
                                    "share of the kinetic energy across the string"),
        value<M, &M::torsional_share>("/modes/torsional_share", "1",
                                      "share of the kinetic energy of turns about the string"),
        value<M, &M::axial_share>("/modes/axial_share", "1",
                                  "share of the kinetic energy along the string"),
        value<M, &M::whirl>("/modes/whirl", "1", whirl_text),
        value<M, &M::crossings>("/modes/crossings", "1",
                                "places where the string rests, its ends left out"),
        value<M, &M::bending_place>("/modes/bending_place", "m",
                                    "place of the largest bending moment, along the string"),
        values<M, &M::displacement>("/modes/shape", Rows::nodes, "m",
                                    "displacement: north, east, down; the largest is 1 m, or the "
                                    "largest turn of a torsional mode 1 rad"),
        values<M, &M::turn>("/modes/shape_turn", Rows::nodes, "rad",
                            "turn about north, east, down"),
        values<M, &M::later_displacement>("/modes/later_shape", Rows::nodes, "m",
                                          "displacement a quarter of a period later"),
        values<M, &M::later_turn>("/modes/later_shape_turn", Rows::nodes, "rad",
                                  "turn a quarter of a period later"),
    };
    return table;
}

const std::vector<RecordDataset<CampbellPoint>>& campbell_datasets() {
    using C = CampbellPoint;
    static const std::vector<RecordDataset<C>> table = {
        value<C, &C::rotation_rate>("/modes/campbell/rotation_rate", "rad/s",
                                    "rate at which the string turns, ascending"),
        frequency<C>("/modes/campbell/frequency", "natural frequency at that rate, ascending"),
        value<C, &C::kind>("/modes/campbell/kind", "1", kind_text),
        value<C, &C::whirl>("/modes/campbell/whirl", "1", whirl_text),
    };
    return table;
}

const std::vector<RecordDataset<CriticalSpeed>>& critical_speed_datasets() {
    using C = CriticalSpeed;
    static const std::vector<RecordDataset<C>> table = {
        value<C, &C::order>("/modes/critical/order", "1",
                            "frequency over the rate at which the string turns"),
        value<C, &C::rotation_rate>("/modes/critical/rotation_rate", "rad/s",
                                    "rate at which that order meets a natural frequency"),
        value<C, &C::kind>("/modes/critical/kind", "1", kind_text),
        value<C, &C::whirl>("/modes/critical/whirl", "1", whirl_text),
    };
    return table;
}

const std::vector<RecordDataset<ForcedResponse>>& response_datasets() {
    using R = ForcedResponse;
    static const std::vector<RecordDataset<R>> table = {
        value<R, &R::rotation_rate>("/modes/response/rotation_rate", "rad/s",
                                    "rate at which the string turns"),
        frequency<R>("/modes/response/frequency", "frequency of the vibration"),
        values<R, &R::displacement>("/modes/response/displacement", Rows::nodes, "m",
                                    "amplitude of the displacement"),
        values<R, &R::twist>("/modes/response/twist", Rows::nodes, "rad",
                             "amplitude of the turn about the string"),
        values<R, &R::side_force>("/modes/response/side_force", Rows::nodes, "N",
                                  "amplitude of the force of the wall on the node's cell"),
        values<R, &R::bending_moment>("/modes/response/bending_moment", Rows::segments, "N m",
                                      "amplitude of the bending moment"),
        values<R, &R::torque>("/modes/response/torque", Rows::segments, "N m",
                              "amplitude of the torque"),
        values<R, &R::axial_force>("/modes/response/axial_force", Rows::segments, "N",
                                   "amplitude of the axial force"),
    };
    return table;
}

}  // namespace drillstrand
