/// Typed errors of the engine. The engine never prints and never exits: it throws one of these, and
/// the program turns it into one line and an exit code.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace drillstrand {

/// A place in an input file; line and column count from 1, 0 means "the whole file".
struct SourceLocation {
    std::string file;
    std::size_t line = 0;
    std::size_t column = 0;
};

/// The user's input is wrong. what() is "FILE:LINE:COL: what is wrong; what would be right".
class InputError : public std::runtime_error {
  public:
    InputError(const SourceLocation& where, const std::string& problem);

    [[nodiscard]] const SourceLocation& where() const { return where_; }

  private:
    SourceLocation where_;
};

/// The simulation cannot go on (diverged, step underflow, a physical guard). what() says which
/// quantity, where along the string and when.
class SimulationError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// A physical guard stopped the run: the numbers are sound, but the string would have failed, or
/// the mesh cannot follow its motion. what() names the guard, the segment, its place along the
/// string and the time.
class GuardError : public SimulationError {
  public:
    using SimulationError::SimulationError;
};

/// A result file cannot be read, or not be written there (not a result file, a folder of that name,
/// another run writes it).
class ResultError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Writing failed although nothing was wrong with what was asked for (disk full, the file was
/// deleted meanwhile).
class WriteError : public ResultError {
  public:
    using ResultError::ResultError;
};

}  // namespace drillstrand
