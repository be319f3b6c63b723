#include "drillstrand/last_part.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "rod/autodriller.hpp"

namespace drillstrand {

namespace {

using Sample = LastPart::Sample;

constexpr double longest = 30;            // s
constexpr double share_of_run = 1.0 / 3;  // that is the last part of a short one
constexpr double least_interval = 0.01;   // s
constexpr double least_duration = 1;      // s, of a part that is worth a warning
constexpr double much_whirl = 0.3;        // of the string
constexpr double rolls = 0.8;             // of the rate without slip: below it the pipe slides
constexpr double much_of_bit = 0.2;       // of the weight on bit
constexpr double much_of_hook = 0.02;     // of the hook load
constexpr double least_rotation = 0.1;    // rad/s, about 1 rpm: slower is no rotation
constexpr double full_stick_slip = 1;     // index of a bit that just comes to rest
constexpr double moderate_stick_slip = 0.5;

constexpr std::array parts = {
    &Sample::time,          &Sample::forward,       &Sample::backward,   &Sample::whirl_rate,
    &Sample::rolling_rate,  &Sample::whirl_depth,   &Sample::kinetic,    &Sample::rotation,
    &Sample::drag,          &Sample::drag_size,     &Sample::drag_depth, &Sample::hook_load,
    &Sample::weight_on_bit, &Sample::rotation_rate, &Sample::bit_rate,   &Sample::bit_load};

template <class Follow>
void follow_hoist(const HoistCase& hoist, const Follow& follow) {
    follow(hoist.block_speed);
    if (hoist.hook_load) follow(*hoist.hook_load);
    if (!hoist.autodriller) return;
    for (const auto& loop : driller_loops(*hoist.autodriller))
        if (loop) follow(loop->limit);
}

/// Time of the last point of any schedule of loads or rotation (s).
double last_change(const Scene& scene) {
    double last = 0;
    const auto follow = [&](const auto& schedule) {
        last = std::max(last, schedule.times().back());
    };
    if (scene.head.motion != HeadMotion::free) {
        follow(scene.head.rotation);
        follow(scene.head.tilting);
        follow(scene.head.velocity);
        if (scene.head.hoist) follow_hoist(*scene.head.hoist, follow);
    } else {
        follow(scene.head.force);
        follow(scene.head.moment);
    }
    follow(scene.bit.weight);
    follow(scene.bit.torque);
    follow(scene.bit.feed);
    follow(scene.bit.force);
    follow(scene.bit.dead_moment);
    follow(scene.bit.moment);
    return last;
}

Sample sample_of(const SeriesRecord& record) {
    const Whirl& whirl = record.whirl;
    const double share = whirl.forward + whirl.backward;
    const double drag_size = std::abs(record.wall_drag);
    return {record.time,
            whirl.forward,
            whirl.backward,
            share * whirl.rate,
            share * whirl.rolling_rate,
            share * whirl.depth,
            record.energy.kinetic,
            record.energy.rotation,
            record.wall_drag,
            drag_size,
            drag_size * record.drag_depth,
            record.hook_load,
            record.weight_on_bit,
            std::abs(record.head_rotation_rate),
            std::copysign(1.0, record.head_rotation_rate) * record.bit_rotation_rate,
            -record.bit_stress[3]};
}

double ratio(double a, double b) {
    return b != 0 ? a / b : 0;
}

bool rotates(const Sample& mean) {
    return mean.rotation_rate >= least_rotation;
}

bool is_on_bottom(const Sample& mean) {
    return mean.weight_on_bit > 0;
}

const char* severity(double stick_slip_index) {
    if (stick_slip_index >= full_stick_slip) return "full stick-slip";
    return stick_slip_index >= moderate_stick_slip ? "moderate" : "low";
}

std::string stick_slip_text(const BitConduct& bit) {
    const std::string index =
        std::isfinite(bit.stick_slip_index)
            ? fmt::format("index {:.3g} ({})", bit.stick_slip_index, severity(bit.stick_slip_index))
            : "the bit hardly turns";
    return fmt::format(
        "{}; the bit turns at {:.3g} to {:.3g} rad/s, mean {:.3g} rad/s, and is stuck for {:.0f} % "
        "of the time",
        index, bit.least_rate, bit.most_rate, bit.mean_rate, 100 * bit.stuck);
}

std::string bounce_text(const BitConduct& bit) {
    return fmt::format(
        "the bit carries no load for {:.0f} % of the time; compression above it "
        "{:.4g} to {:.4g} kN",
        100 * bit.unloaded, 1e-3 * bit.least_load, 1e-3 * bit.most_load);
}

std::string energy_text(const Sample& mean) {
    return fmt::format("kinetic energy {:.3g} kJ, {:.3g} times that of rotation",
                       1e-3 * mean.kinetic, ratio(mean.kinetic, mean.rotation));
}

std::string whirl_text(const Sample& mean) {
    const double share = mean.forward + mean.backward;
    if (share == 0) return fmt::format("none; {}", energy_text(mean));
    return fmt::format(
        "{:.0f} % of the string backward, {:.0f} % forward, at {:.3g} rad/s around the well "
        "({:.3g} rad/s would roll without slip), middle at {:.4g} m of measured depth; {}",
        100 * mean.backward, 100 * mean.forward, mean.whirl_rate / share, mean.rolling_rate / share,
        mean.whirl_depth / share, energy_text(mean));
}

/// Which way the walls push the string.
const char* way(const Sample& mean) {
    return mean.drag > 0 ? "down" : "up";
}

std::string drag_text(const Sample& mean) {
    constexpr double noticeable = 10;  // N
    const bool drags = std::abs(mean.drag) >= noticeable;
    std::string text = "no friction along the well";
    if (drags)
        text =
            fmt::format("friction of {:.4g} kN {} the well", 1e-3 * std::abs(mean.drag), way(mean));
    if (drags && mean.drag_size > 0)
        text +=
            fmt::format(", middle at {:.4g} m of measured depth", mean.drag_depth / mean.drag_size);
    text += fmt::format("; weight on bit {:.4g} kN", 1e-3 * mean.weight_on_bit);
    if (drags && mean.weight_on_bit > 0)
        text += fmt::format(" ({:.2f} of it)", std::abs(mean.drag) / mean.weight_on_bit);
    return text + fmt::format(", hook load {:.4g} kN", 1e-3 * mean.hook_load);
}

bool whirls_much(const Sample& mean) {
    return mean.backward - mean.forward > much_whirl;
}

std::string whirl_warning(const Sample& mean, const std::string& when) {
    const double share = mean.forward + mean.backward;
    const double of_rolling = ratio(mean.whirl_rate, mean.rolling_rate);
    return fmt::format(
        "{:.0f} % of the string {} in backward whirl {} ({:.3g} rad/s around the well, {:.2f} of "
        "the rate without slip, middle at {:.4g} m of measured depth); whether it is real would "
        "tell: a finer mesh (mesh.segments), a shorter step (run.cfl), the mass of the mud "
        "(fluid.added_mass)",
        100 * mean.backward, of_rolling > rolls ? "rolls" : "slides", when, mean.whirl_rate / share,
        of_rolling, mean.whirl_depth / share);
}

bool walls_carry_much(const Sample& mean) {
    const double drag = std::abs(mean.drag);
    return rotates(mean) && mean.weight_on_bit > 0 && drag > much_of_bit * mean.weight_on_bit &&
           drag > much_of_hook * std::abs(mean.hook_load);
}

std::string lock_warning(const Sample& mean, const std::string& when) {
    return fmt::format(
        "weight does not arrive: the walls push the rotating string {} the well with {:.4g} kN {}, "
        "{:.2f} times the weight on bit, middle at {:.4g} m of measured depth",
        way(mean), 1e-3 * std::abs(mean.drag), when, std::abs(mean.drag) / mean.weight_on_bit,
        mean.drag_depth / mean.drag_size);
}

}  // namespace

LastPart::LastPart(const Scene& scene, double start)
    : well_(scene.well.has_value()), start_(start), loads_change_until_(last_change(scene)) {}

void LastPart::add(const SeriesRecord& record) {
    if (record.time < start_) return;
    if (!samples_.empty() && record.time - samples_.back().time < least_interval) return;
    samples_.push_back(sample_of(record));
    double from = record.time - std::min(longest, share_of_run * record.time);
    if (loads_change_until_ < record.time) from = std::max(from, loads_change_until_);
    while (samples_.front().time < from)
        samples_.pop_front();
}

double LastPart::duration() const {
    return samples_.empty() ? 0 : samples_.back().time - samples_.front().time;
}

std::string LastPart::when() const {
    return fmt::format("in the last {:.3g} s{}", duration(),
                       is_steady() ? "" : ", before loads are constant");
}

Sample LastPart::mean() const {
    Sample mean;
    for (const auto part : parts) {
        for (const Sample& sample : samples_)
            mean.*part += sample.*part;
        mean.*part /= static_cast<double>(samples_.size());
    }
    return mean;
}

BitConduct LastPart::bit() const {
    BitConduct bit;
    if (samples_.empty()) return bit;
    const auto rate_order = [](const Sample& a, const Sample& b) {
        return a.bit_rate < b.bit_rate;
    };
    const auto load_order = [](const Sample& a, const Sample& b) {
        return a.bit_load < b.bit_load;
    };
    const auto [slowest, fastest] =
        std::minmax_element(samples_.begin(), samples_.end(), rate_order);
    const auto [lightest, heaviest] =
        std::minmax_element(samples_.begin(), samples_.end(), load_order);
    bit.least_rate = slowest->bit_rate;
    bit.most_rate = fastest->bit_rate;
    bit.least_load = lightest->bit_load;
    bit.most_load = heaviest->bit_load;
    const Sample found = mean();
    bit.mean_rate = found.bit_rate;
    const auto share = [&](auto&& holds) {
        return static_cast<double>(std::count_if(samples_.begin(), samples_.end(), holds)) /
               static_cast<double>(samples_.size());
    };
    if (rotates(found)) {
        bit.stick_slip_index = bit.mean_rate >= least_rotation
                                   ? (bit.most_rate - bit.least_rate) / (2 * bit.mean_rate)
                                   : INFINITY;
        bit.stuck = share([](const Sample& sample) { return sample.bit_rate < least_rotation; });
    }
    if (is_on_bottom(found))
        bit.unloaded = share([](const Sample& sample) { return sample.bit_load <= 0; });
    return bit;
}

std::vector<std::string> LastPart::findings() const {
    if (samples_.size() < 2) return {};
    const Sample found = mean();
    std::vector<std::string> lines;
    if (rotates(found))
        lines.push_back(fmt::format("stick-slip: {}: {}", when(), stick_slip_text(bit())));
    if (is_on_bottom(found))
        lines.push_back(fmt::format("bounce: {}: {}", when(), bounce_text(bit())));
    if (!well_) return lines;
    if (rotates(found) || whirls_much(found))
        lines.push_back(fmt::format("whirl: {}: {}", when(), whirl_text(found)));
    lines.push_back(fmt::format("walls: {}: {}", when(), drag_text(found)));
    return lines;
}

std::vector<std::string> LastPart::warnings() const {
    if (duration() < least_duration) return {};
    const Sample found = mean();
    std::vector<std::string> sentences;
    if (whirls_much(found)) sentences.push_back(whirl_warning(found, when()));
    if (is_steady() && walls_carry_much(found)) sentences.push_back(lock_warning(found, when()));
    return sentences;
}

SavedState LastPart::save() const {
    SavedRow row{"last_part",
                 "1, then s, 1, 1, rad/s, rad/s, m, J, J, N, N, N m, N, N, rad/s, rad/s, N of each "
                 "sample",
                 {static_cast<double>(samples_.size())}};
    for (const Sample& sample : samples_)
        for (const auto part : parts)
            row.values.push_back(sample.*part);
    return {row};
}

void LastPart::restore(const SavedState& saved) {
    const auto row = std::find_if(saved.begin(), saved.end(), [](const SavedRow& candidate) {
        return candidate.name == "last_part";
    });
    if (row == saved.end() || row->values.size() % parts.size() != 1)
        throw std::invalid_argument("the saved summary has no row last_part");
    samples_.clear();
    for (auto value = row->values.begin() + 1; value != row->values.end();) {
        Sample& sample = samples_.emplace_back();
        for (const auto part : parts)
            sample.*part = *value++;
    }
}

}  // namespace drillstrand
