#pragma once

#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

namespace perifrac {

/// The scene, the command line or a file given to us cannot be used: exit code 2, nothing written.
/// what() is the whole line for the user: `file:line:column: problem; what is expected;
/// suggestion`.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What a physics asks of the body cannot be had with its shape and spacing. Whoever knows the
/// scene makes an InputError of it, placed at the body.
class BodyError : public std::runtime_error {
 public:
  BodyError(const std::string& problem, std::string expected)
      : std::runtime_error(problem), expected_(std::move(expected)) {}

  const std::string& expected() const { return expected_; }

 private:
  std::string expected_;
};

/// A place for NumericalError: `point 37 at (1, 3) m`; `position` in [m], one value a coordinate.
std::string describe_point(std::size_t point, std::span<const double> position);

/// The run went wrong numerically: exit code 1, the last good checkpoint is kept.
class NumericalError : public std::runtime_error {
 public:
  /// `field` is the name that visit_state gives, `place` says where (a point and its position, or
  /// the solver), `time` is in [s].
  NumericalError(std::string field, std::string place, double time, std::string problem);

  const std::string& field() const { return field_; }
  const std::string& place() const { return place_; }
  double time() const { return time_; }

 private:
  std::string field_;
  std::string place_;
  double time_;
};

/// A NumericalError that no shorter window gets past: none is tried.
class FinalError : public NumericalError {
 public:
  using NumericalError::NumericalError;
};

/// A result cannot be written (disk full, folder gone): exit code 1, the last good checkpoint is
/// kept.
class OutputError : public std::runtime_error {
 public:
  /// `reason` is what the operating system or the library says.
  OutputError(const std::string& file, const std::string& reason);
};

}  // namespace perifrac
