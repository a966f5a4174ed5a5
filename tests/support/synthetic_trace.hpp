#pragma once

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "core/vec.hpp"
#include "results/trace/columns.hpp"
#include "results/trace/csv_trace.hpp"
#include "results/trace/sample.hpp"

/// A trace with closed forms behind it, for the tests of everything that reads traces.
namespace twin::test {

/// Shape and errors of a synthetic run.
///
/// The path is a trefoil r(phi) = radius (1 + 0.35 cos 3 phi), phi(t) = 2 pi w(t / duration) with
/// the smooth step w(u) = u^3 (10 - 15 u + 6 u^2), so that it starts and ends at rest. The table
/// lags by lag and shakes by ripple.
struct SyntheticRun {
  double radius = 25.0;        ///< mean radius [mm]
  double duration = 4.0;       ///< [s]
  double period = 0.001;       ///< [s]
  double lag = 0.0001;         ///< lag of the table behind the set point [s]
  double ripple = 0.004;       ///< amplitude of the normal error [mm]
  double resolution = 0.0005;  ///< of the encoder [mm]
};

inline Vec2 trefoil(const SyntheticRun& run, double t) {
  const double u = std::fmin(std::fmax(t / run.duration, 0.0), 1.0);
  const double phi = 2.0 * std::numbers::pi * u * u * u * (10.0 - 15.0 * u + 6.0 * u * u);
  const double r = run.radius * (1.0 + 0.35 * std::cos(3.0 * phi));
  return {r * std::cos(phi), r * std::sin(phi)};
}

/// The sample at time t; contour_error receives the size of the ripple's part [mm].
inline results::Sample synthetic_sample(const SyntheticRun& run, double t, double& contour_error) {
  constexpr double kStep = 1e-6;  // [s]
  results::Sample sample;
  const Vec2 command = trefoil(run, t);
  const Vec2 velocity = (trefoil(run, t + kStep) - trefoil(run, t - kStep)) / (2.0 * kStep);
  const double phase = 2.0 * std::numbers::pi * t;
  contour_error = run.ripple * std::sin(7.0 * phase) * std::sin(0.5 * phase);
  sample.t = t;
  sample.segment = static_cast<std::int64_t>(t / run.duration * 60.0);
  sample.line = 10 + static_cast<std::int64_t>(t / run.duration * 1200.0);
  sample.command = {command.x(), command.y(), 0.0};
  sample.feedrate = velocity.norm();
  sample.feedrate_limit = 60.0;
  const Vec2 normal = command.normalized();
  sample.table = trefoil(run, t - run.lag) + contour_error * normal;
  sample.encoder = (sample.table / run.resolution).array().round().matrix() * run.resolution;
  sample.volts = velocity / 25.0;
  contour_error = std::fabs(contour_error);
  return sample;
}

/// Writes DIR/trace.csv. @returns number of rows
inline Expected<int> write_synthetic_trace(const std::filesystem::path& directory,
                                           const SyntheticRun& run,
                                           results::Layout layout = results::Layout::kRun) {
  std::vector<double> values;
  const int rows = static_cast<int>(std::lround(run.duration / run.period)) + 1;
  for (int k = 0; k < rows; ++k) {
    double contour_error = 0.0;
    const results::Sample sample = synthetic_sample(run, k * run.period, contour_error);
    results::append_row(sample, contour_error, layout, values);
  }
  results::CsvTrace trace(directory);
  if (auto error = trace.begin(results::trace_header(layout, run.period))) {
    return tl::unexpected(*error);
  }
  if (auto error = trace.rows(values)) {
    return tl::unexpected(*error);
  }
  if (auto error = trace.commit()) {
    return tl::unexpected(*error);
  }
  return rows;
}

/// The programmed path as a polyline.
inline std::vector<Vec2> synthetic_path(const SyntheticRun& run, int points = 2000) {
  std::vector<Vec2> path;
  for (int i = 0; i <= points; ++i) {
    path.push_back(trefoil(run, run.duration * i / points));
  }
  return path;
}

}  // namespace twin::test
