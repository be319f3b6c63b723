#include "input/operations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "drillstrand/units.hpp"
#include "input/plausible.hpp"

namespace drillstrand {

namespace {

/// Points of a schedule in the order of time.
class Course {
  public:
    [[nodiscard]] double value() const { return values_.back(); }
    /// What it has until a time it keeps until then.
    void stay_until(double time) { set(time, value()); }
    void set(double time, double value) {
        if (time > times_.back()) {
            times_.push_back(time);
            values_.push_back(value);
        } else {
            values_.back() = value;
        }
    }
    [[nodiscard]] ScalarSchedule schedule() const { return {times_, values_}; }

  private:
    std::vector<double> times_{0.0};
    std::vector<double> values_{0.0};
};

/// The rest of a text after a word; none where it begins otherwise.
std::optional<std::string_view> after(std::string_view text, std::string_view word) {
    if (text.substr(0, word.size()) != word) return std::nullopt;
    return text.substr(word.size());
}

/// The parts of "FIRST WORD SECOND"; the second is empty where the word is not there.
std::pair<std::string_view, std::string_view> split(std::string_view text, std::string_view word) {
    const std::size_t at = text.find(word);
    if (at == std::string_view::npos) return {text, {}};
    return {text.substr(0, at), text.substr(at + word.size())};
}

class Rig {
  public:
    explicit Rig(double ramp) : ramp_(ramp) {}

    void take(const Value& operation);
    [[nodiscard]] Operations operations() {
        return {rotation_.schedule(), speed_.schedule(), std::move(slips_)};
    }

  private:
    static double quantity(const Value& operation, std::string_view text,
                           const Dimension& dimension, const Range& range);

    void wait(double duration);
    void rotate(double rate, double ramp);
    void move(double way, double speed);
    void move_in_words(const Value& operation, std::string_view text, double sense,
                       std::string_view example);
    void enter_slips();
    void leave_slips();

    double ramp_;
    double time_ = 0;
    Course rotation_;
    Course speed_;
    std::vector<TimeSpan> slips_;
};

double Rig::quantity(const Value& operation, std::string_view text, const Dimension& dimension,
                     const Range& range) {
    try {
        const double value = parse_quantity(text, dimension);
        if (range.contains(value)) return value;
    } catch (const std::invalid_argument& error) {
        operation.fail(fmt::format("is \"{}\": {}", operation.text(), error.what()));
    }
    operation.fail(fmt::format("is \"{}\": {} is out of range; expected {}", operation.text(), text,
                               range.describe()));
}

void Rig::wait(double duration) {
    time_ += duration;
    rotation_.stay_until(time_);
    speed_.stay_until(time_);
}

void Rig::rotate(double rate, double ramp) {
    rotation_.stay_until(time_);
    time_ += ramp;
    rotation_.set(time_, rate);
    speed_.stay_until(time_);
}

/// At a speed that is reached and left in a ramp; over a short way at less, as quickly reached.
void Rig::move(double way, double speed) {
    const double size = std::abs(speed);
    const bool is_short = way < size * ramp_;
    const double ramp = is_short ? std::sqrt(way * ramp_ / size) : ramp_;
    const double peak = is_short ? speed * ramp / ramp_ : speed;
    const double steady = is_short ? 0.0 : way / size - ramp_;
    speed_.stay_until(time_);
    speed_.set(time_ + ramp, peak);
    speed_.set(time_ + ramp + steady, peak);
    time_ += 2 * ramp + steady;
    speed_.set(time_, 0.0);
    rotation_.stay_until(time_);
}

void Rig::move_in_words(const Value& operation, std::string_view text, double sense,
                        std::string_view example) {
    const auto [way, speed] = split(text, " at ");
    if (speed.empty())
        operation.fail(
            fmt::format("is \"{}\" without a speed; expected {}", operation.text(), example));
    leave_slips();
    const double length = quantity(operation, way, dimension::length, plausible::length);
    move(length, sense * quantity(operation, speed, dimension::speed, plausible::feed));
}

void Rig::enter_slips() {
    if (rotation_.value() != 0) rotate(0, ramp_);
    slips_.push_back({time_, std::numeric_limits<double>::infinity()});
}

void Rig::leave_slips() {
    if (!slips_.empty()) slips_.back().end = std::min(slips_.back().end, time_);
}

void Rig::take(const Value& operation) {
    const std::string text = operation.text();
    if (text == "slips in") return enter_slips();
    if (text == "slips out") return leave_slips();
    if (const auto duration = after(text, "wait "))
        return wait(quantity(operation, *duration, dimension::time, plausible::duration));
    if (const auto turning = after(text, "rotate ")) {
        leave_slips();
        const auto [rate, ramp] = split(*turning, " in ");
        return rotate(
            quantity(operation, rate, dimension::frequency, plausible::rotation),
            ramp.empty() ? ramp_ : quantity(operation, ramp, dimension::time, plausible::duration));
    }
    if (const auto down = after(text, "trip in "))
        return move_in_words(operation, *down, 1, "trip in 28 m at 0.3 m/s");
    if (const auto up = after(text, "trip out "))
        return move_in_words(operation, *up, -1, "trip out 28 m at 0.3 m/s");
    if (const auto down = after(text, "drill "))
        return move_in_words(operation, *down, 1, "drill 5 m at 20 m/h");
    operation.fail(fmt::format(
        "is \"{}\"; expected slips in, slips out, rotate 120 rpm, trip in 28 m at 0.3 m/s, "
        "trip out 28 m at 0.3 m/s, drill 5 m at 20 m/h or wait 10 s",
        text));
}

}  // namespace

Operations operations_in_words(const Value& list, double ramp) {
    Rig rig(ramp);
    for (const Value& operation : list.elements("a list of operations in words"))
        rig.take(operation);
    return rig.operations();
}

}  // namespace drillstrand
