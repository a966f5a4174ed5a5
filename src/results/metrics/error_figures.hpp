#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "results/metrics/place.hpp"
#include "results/metrics/running.hpp"
#include "results/metrics/summary.hpp"

namespace twin::results {

/// Largest value, where it was, and root mean square of an error, as samples come.
class ErrorFigures {
 public:
  /// @param error  at least 0 [mm]
  void add(double error, const Place& place) noexcept {
    if (error > values_.max() || !at_) {
      at_ = place;
    }
    values_.add(error);
  }
  ErrorStats stats() const noexcept { return {values_.max(), values_.rms(), at_}; }
  std::int64_t count() const noexcept { return values_.count(); }

 private:
  Running values_;
  std::optional<Place> at_;
};

/// The errors of one sample [mm].
struct SampleErrors {
  double command = 0.0;              ///< contour error of the set point
  double encoder = 0.0;              ///< contour error of the encoder's position
  double table = 0.0;                ///< contour error of the table's true position
  std::array<double, 2> tracking{};  ///< sizes, x and y
};

/// The figures of all the errors of a motion.
struct MotionFigures {
  ErrorFigures command;
  ErrorFigures encoder;
  ErrorFigures table;
  std::array<ErrorFigures, 2> tracking;  ///< x, y

  void add(const SampleErrors& errors, const Place& place) noexcept {
    command.add(errors.command, place);
    encoder.add(errors.encoder, place);
    table.add(errors.table, place);
    for (std::size_t i = 0; i < 2; ++i) {
      tracking[i].add(errors.tracking[i], place);
    }
  }
};

}  // namespace twin::results
