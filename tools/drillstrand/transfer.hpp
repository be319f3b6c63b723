/// Results through a pipe. One list of members serves both directions, and each names all members
/// of its struct, so that it does not compile where one was added and forgotten here.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "drillstrand/buckling_file.hpp"
#include "drillstrand/checkpoint.hpp"
#include "drillstrand/modes_file.hpp"
#include "drillstrand/result_file.hpp"
#include "drillstrand/result_layout.hpp"
#include "drillstrand/torque_drag_file.hpp"

namespace drillstrand::program {

/// The other end of a pipe is gone before everything went through.
class BrokenPipe : public std::runtime_error {
  public:
    BrokenPipe() : std::runtime_error("broken pipe") {}
};

/// Writes values into a pipe.
class Sender {
  public:
    explicit Sender(int pipe) : pipe_(pipe) { buffer_.reserve(block); }

    template <class Value>
    requires std::is_arithmetic_v<Value>
    void value(const Value& value) { bytes(reinterpret_cast<const char*>(&value), sizeof value); }

    template <class List>
    void list(const List& list) {
        value(static_cast<std::uint64_t>(list.size()));
        bytes(reinterpret_cast<const char*>(list.data()),
              list.size() * sizeof(typename List::value_type));
    }

    void flush() {
        for (std::size_t sent = 0; sent < buffer_.size();) {
            const ssize_t count = ::write(pipe_, buffer_.data() + sent, buffer_.size() - sent);
            if (count < 0 && errno == EINTR) continue;
            if (count <= 0) throw BrokenPipe();
            sent += static_cast<std::size_t>(count);
        }
        buffer_.clear();
    }

  private:
    static constexpr std::size_t block = std::size_t{1} << 16;

    void bytes(const char* data, std::size_t count) {
        while (count > 0) {
            const std::size_t part = std::min(count, block - buffer_.size());
            buffer_.append(data, part);
            if (buffer_.size() == block) flush();
            data += part;
            count -= part;
        }
    }

    int pipe_;
    std::string buffer_;
};

/// Reads them at the other end. Takes memory only for what has arrived.
class Receiver {
  public:
    explicit Receiver(int pipe) : pipe_(pipe) {}

    template <class Value>
    requires std::is_arithmetic_v<Value>
    void value(Value& value) { bytes(reinterpret_cast<char*>(&value), sizeof value); }

    template <class List>
    void list(List& list) {
        std::uint64_t count = 0;
        value(count);
        list.clear();
        for (std::uint64_t got = 0; got < count; got = list.size()) {
            const std::uint64_t next = std::min<std::uint64_t>(block, count - got);
            list.resize(got + next);
            bytes(reinterpret_cast<char*>(list.data() + got),
                  next * sizeof(typename List::value_type));
        }
    }

  private:
    static constexpr std::size_t block = std::size_t{1} << 16;

    void bytes(char* data, std::size_t count) {
        while (count > 0) {
            if (next_ == arrived_) fill();
            const std::size_t part = std::min(count, arrived_ - next_);
            std::memcpy(data, buffer_.data() + next_, part);
            next_ += part;
            data += part;
            count -= part;
        }
    }

    void fill() {
        ssize_t got = 0;
        do
            got = ::read(pipe_, buffer_.data(), buffer_.size());
        while (got < 0 && errno == EINTR);
        if (got <= 0) throw BrokenPipe();
        next_ = 0;
        arrived_ = static_cast<std::size_t>(got);
    }

    int pipe_;
    std::vector<char> buffer_ = std::vector<char>(block);
    std::size_t next_ = 0;
    std::size_t arrived_ = 0;
};

template <class Value>
constexpr bool is_list =
    std::is_same_v<Value, std::string> || std::is_same_v<Value, std::vector<double>>;

template <class Pipe, class Value>
requires std::is_arithmetic_v<Value>
void transfer(Pipe& pipe, Value& value) {
    pipe.value(value);
}

template <class Pipe, class Value>
requires is_list<Value>
void transfer(Pipe& pipe, Value& value) {
    pipe.list(value);
}

template <class Pipe, class Value>
requires std::is_enum_v<Value>
void transfer(Pipe& pipe, Value& value) {
    auto number = static_cast<std::int64_t>(value);
    pipe.value(number);
    value = static_cast<Value>(number);
}

template <class Pipe, class... Values>
void transfer_all(Pipe& pipe, Values&... values);

/// Rows of a list, one after the other: `list` ends up with as many as were sent.
template <class Pipe, class Row>
requires(!is_list<std::vector<Row>>) void transfer(Pipe& pipe, std::vector<Row>& rows) {
    std::uint64_t count = rows.size();
    pipe.value(count);
    if constexpr (std::is_same_v<Pipe, Receiver>) rows.clear();
    for (std::uint64_t k = 0; k < count; ++k) {
        if constexpr (std::is_same_v<Pipe, Receiver>) rows.emplace_back();
        transfer(pipe, rows[k]);
    }
}

template <class Pipe>
void transfer(Pipe& pipe, SurveyStation& station) {
    auto& [measured_depth, inclination, azimuth] = station;
    transfer_all(pipe, measured_depth, inclination, azimuth);
}

template <class Pipe>
void transfer(Pipe& pipe, FrictionCoefficients& friction) {
    auto& [axial, azimuthal] = friction;
    transfer_all(pipe, axial, azimuthal);
}

template <class Pipe>
void transfer(Pipe& pipe, WellSectionCase& section) {
    auto& [to, diameter, end_diameter, name, static_friction, dynamic_friction, normal_stiffness] =
        section;
    transfer_all(pipe, to, diameter, end_diameter, name, static_friction, dynamic_friction,
                 normal_stiffness);
}

template <class Pipe>
void transfer(Pipe& pipe, WellCase& well) {
    auto& [survey, sections] = well;
    transfer_all(pipe, survey, sections);
}

template <class Pipe, class Value>
void transfer(Pipe& pipe, std::optional<Value>& value) {
    bool present = value.has_value();
    pipe.value(present);
    if (!present) return;
    if (!value) value.emplace();
    transfer(pipe, *value);
}

template <class Pipe>
void transfer(Pipe& pipe, CyclesCase& cycles) {
    auto& [interval, slope] = cycles;
    transfer_all(pipe, interval, slope);
}

template <class Pipe>
void transfer(Pipe& pipe, SensorCase& sensor) {
    auto& [name, depth, radius, interval] = sensor;
    transfer_all(pipe, name, depth, radius, interval);
}

template <class Pipe>
void transfer(Pipe& pipe, SegmentCycles& cycles) {
    auto& [count, largest_range, equivalent_range] = cycles;
    transfer_all(pipe, count, largest_range, equivalent_range);
}

template <class Pipe>
void transfer(Pipe& pipe, ResultHeader& header) {
    auto& [title, case_text, integrator, threads, isa, node_s, segment_s, component_name,
           component_start, component_end, cell, mass, weight, outer_radius, polar_inertia,
           metal_area, yield_tension, yield_bending, yield_torque, well, cycles, sensors] = header;
    transfer_all(pipe, title, case_text, integrator, threads, isa, node_s, segment_s,
                 component_name, component_start, component_end, cell, mass, weight, outer_radius,
                 polar_inertia, metal_area, yield_tension, yield_bending, yield_torque, well,
                 cycles, sensors);
}

template <class Pipe>
void transfer(Pipe& pipe, StepStatistics& statistics) {
    auto& [steps, rejected, evaluations, smallest_step, largest_step, time_error] = statistics;
    transfer_all(pipe, steps, rejected, evaluations, smallest_step, largest_step, time_error);
}

template <class Pipe>
void transfer(Pipe& pipe, ResultFooter& footer) {
    auto& [status, wall_seconds, energy_residual, largest_penetration, time_error_median,
           stick_slip_index, stuck_share, unloaded_share, warnings, findings, cycles, statistics] =
        footer;
    transfer_all(pipe, status, wall_seconds, energy_residual, largest_penetration,
                 time_error_median, stick_slip_index, stuck_share, unloaded_share, warnings,
                 findings, cycles, statistics);
}

/// Records by the table of their datasets, as files hold them.
template <class Record>
void transfer_record(Sender& pipe, Record& record,
                     const std::vector<RecordDataset<Record>>& layout) {
    std::vector<double> values;
    for (const auto& entry : layout) {
        values.clear();
        entry.append(record, values);
        pipe.list(values);
    }
}

template <class Record>
void transfer_record(Receiver& pipe, Record& record,
                     const std::vector<RecordDataset<Record>>& layout) {
    std::vector<double> values;
    for (const auto& entry : layout) {
        pipe.list(values);
        if (entry.rows == Rows::one && values.size() != entry.components) throw BrokenPipe();
        entry.assign(record, values.data(), values.size() / entry.components);
    }
}

template <class Pipe>
void transfer(Pipe& pipe, SeriesRecord& record) {
    transfer_record(pipe, record, series_datasets());
}

template <class Pipe>
void transfer(Pipe& pipe, Profile& profile) {
    transfer_record(pipe, profile, profile_datasets());
}

template <class Pipe>
void transfer(Pipe& pipe, SensorRecord& record) {
    static const auto layout = sensor_datasets("");
    transfer_record(pipe, record, layout);
}

template <class Pipe>
void transfer(Pipe& pipe, BucklingMode& mode) {
    transfer_record(pipe, mode, buckling_datasets());
}

template <class Pipe>
void transfer(Pipe& pipe, UnstableMode& mode) {
    transfer_record(pipe, mode, instability_datasets());
}

template <class Pipe>
void transfer(Pipe& pipe, Instability& instability) {
    auto& [load, modes] = instability;
    transfer_all(pipe, load, modes);
}

template <class Pipe>
void transfer(Pipe& pipe, StaticShape& shape) {
    transfer_record(pipe, shape, static_shape_datasets());
}

template <class Pipe>
void transfer(Pipe& pipe, VibrationMode& mode) {
    transfer_record(pipe, mode, mode_datasets());
}

template <class Pipe>
void transfer(Pipe& pipe, CampbellPoint& point) {
    transfer_record(pipe, point, campbell_datasets());
}

template <class Pipe>
void transfer(Pipe& pipe, CriticalSpeed& speed) {
    transfer_record(pipe, speed, critical_speed_datasets());
}

template <class Pipe>
void transfer(Pipe& pipe, Excitation& excitation) {
    auto& [order, unbalance, bit_force, bit_torque] = excitation;
    transfer_all(pipe, order, unbalance, bit_force, bit_torque);
}

template <class Pipe>
void transfer(Pipe& pipe, ForcedResponse& response) {
    transfer_record(pipe, response, response_datasets());
}

/// Values of a motion by the tables of their datasets.
inline void transfer_table(Sender& pipe, TorqueDragCurve& curve,
                           const std::vector<TorqueDragDataset>& table) {
    for (const TorqueDragDataset& entry : table)
        pipe.list(entry.values(curve));
}

inline void transfer_table(Receiver& pipe, TorqueDragCurve& curve,
                           const std::vector<TorqueDragDataset>& table) {
    std::vector<double> values;
    for (const TorqueDragDataset& entry : table) {
        pipe.list(values);
        entry.assign(curve, values);
    }
}

/// All but the reasons of failures, which files do not hold.
template <class Pipe>
void transfer(Pipe& pipe, TorqueDragCurve& curve) {
    transfer(pipe, curve.motion);
    transfer_table(pipe, curve, torque_drag_depth_datasets());
    transfer_table(pipe, curve, torque_drag_profile_datasets());
}

template <class Pipe>
void transfer(Pipe& pipe, TorqueDrag& study) {
    auto& [bit_depth, node_s, segment_s, measured_depth, curves] = study;
    transfer_all(pipe, bit_depth, node_s, segment_s, measured_depth, curves);
}

template <class Pipe>
void transfer(Pipe& pipe, Result& result) {
    auto& [header, footer, version, commit, series, profiles, sensors] = result;
    transfer_all(pipe, header, footer, version, commit, series, profiles, sensors);
}

template <class Pipe>
void transfer(Pipe& pipe, BucklingResult& result) {
    auto& [header, discretisation, modes, instability, version, commit] = result;
    transfer_all(pipe, header, discretisation, modes, instability, version, commit);
}

template <class Pipe>
void transfer(Pipe& pipe, TorqueDragResult& result) {
    auto& [header, study, version, commit] = result;
    transfer_all(pipe, header, study, version, commit);
}

template <class Pipe>
void transfer(Pipe& pipe, ModesResult& result) {
    auto& [header, rotation_rate, grip, shape, modes, campbell, critical_speeds, excitation,
           response, version, commit] = result;
    transfer_all(pipe, header, rotation_rate, grip, shape, modes, campbell, critical_speeds,
                 excitation, response, version, commit);
}

template <class Pipe>
void transfer(Pipe& pipe, SavedRow& row) {
    auto& [name, unit, values] = row;
    transfer_all(pipe, name, unit, values);
}

template <class Pipe>
void transfer(Pipe& pipe, Checkpoint& checkpoint) {
    auto& [header, version, commit, time, wall_seconds, series, profiles, state, summary, scene] =
        checkpoint;
    transfer_all(pipe, header, version, commit, time, wall_seconds, series, profiles, state,
                 summary, scene);
}

template <class Pipe, class... Values>
void transfer_all(Pipe& pipe, Values&... values) {
    (transfer(pipe, values), ...);
}

}  // namespace drillstrand::program
