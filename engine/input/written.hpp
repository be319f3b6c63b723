/// How the user wrote the quantities of a case, for messages about them.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "drillstrand/error.hpp"
#include "drillstrand/units.hpp"

namespace drillstrand {

/// A value and its place, as a message names them.
struct WrittenValue {
    std::string path;  ///< of its key; empty: there is none
    std::string text;  ///< "19.5 lb/ft"
    SourceLocation where;
};

/// While an object lives, the readers of its thread note each length that they read, so that a
/// message written elsewhere repeats it as the user did.
class WrittenLengths {
  public:
    WrittenLengths();
    WrittenLengths(const WrittenLengths&) = delete;
    WrittenLengths& operator=(const WrittenLengths&) = delete;
    ~WrittenLengths();

    /// What readers say of a quantity (in SI); others than lengths are not kept.
    static void note(double value, const Dimension& dimension, std::string_view text);
    /// What readers say of many lengths in one unit.
    static void note_unit(std::string_view unit);

  private:
    friend std::string length_text(double metres);

    std::map<double, std::string> texts_;
    int in_metres_ = 0;
    int in_feet_ = 0;
    WrittenLengths* outer_;
};

/// A length (m) as the user wrote it, where the case has just this length; others in metres or in
/// feet, as most lengths of the case are. Inches and millimetres have no say in that.
std::string length_text(double metres);

/// Number and unit of "9.8 ppg"; the unit is empty where the text is not of that form ("9 5/8 in").
std::pair<double, std::string_view> number_and_unit(std::string_view text);

}  // namespace drillstrand
