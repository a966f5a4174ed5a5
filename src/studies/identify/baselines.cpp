#include "studies/identify/baselines.hpp"

#include <algorithm>
#include <cmath>

#include "core/linear_algebra.hpp"
#include "studies/identify/least_squares.hpp"

namespace twin::studies::identify {
namespace {

constexpr Eigen::Index kTaps = 10;
constexpr double kLongestDelay = 0.05;  // that is looked for [s]
constexpr int kThirds = 40;             // of the last search's interval, one after the other

double set_point_before(const AxisRecord& record, std::size_t row, std::size_t rows_ago) {
  return record.command[row - std::min(row, rows_ago)].position;
}

double delayed_at(const AxisRecord& record, std::size_t row, double rows_ago) {
  const double whole = std::floor(rows_ago);
  const auto ago = static_cast<std::size_t>(whole);
  const double near = set_point_before(record, row, ago);
  return near + (rows_ago - whole) * (set_point_before(record, row, ago + 1) - near);
}

/// Sum of squares of measured less delayed set point.
double cost_of_delay(std::span<const AxisRecord> records, double rows_ago) {
  double sum = 0.0;
  const auto first = static_cast<std::size_t>(std::ceil(rows_ago)) + 1;
  for (const AxisRecord& record : records) {
    for (std::size_t k = first; k < record.measured.size(); ++k) {
      const double error = record.measured[k] - delayed_at(record, k, rows_ago);
      sum += record.counts(k) ? error * error : 0.0;
    }
  }
  return sum;
}

}  // namespace

double fit_delay(std::span<const AxisRecord> records, double period) {
  double best = 0.0;
  double least = cost_of_delay(records, 0.0);
  for (double rows_ago = 1.0; rows_ago * period < kLongestDelay; rows_ago += 1.0) {
    if (const double cost = cost_of_delay(records, rows_ago); cost < least) {
      least = cost;
      best = rows_ago;
    }
  }
  double low = std::max(best - 1.0, 0.0);
  double high = best + 1.0;
  for (int i = 0; i < kThirds; ++i) {
    const double a = low + (high - low) / 3.0;
    const double b = high - (high - low) / 3.0;
    (cost_of_delay(records, a) < cost_of_delay(records, b) ? high : low) =
        cost_of_delay(records, a) < cost_of_delay(records, b) ? b : a;
  }
  return 0.5 * (low + high) * period;
}

std::vector<double> delayed_command(const AxisRecord& record, double period, double delay) {
  std::vector<double> positions;
  for (std::size_t k = 0; k < record.command.size(); ++k) {
    positions.push_back(delayed_at(record, k, delay / period));
  }
  return positions;
}

Eigen::VectorXd fit_taps(std::span<const AxisRecord> records) {
  Eigen::Index rows = 0;
  for (const AxisRecord& record : records) {
    rows += static_cast<Eigen::Index>(record.measured.size());
  }
  Eigen::MatrixXd w = Eigen::MatrixXd::Zero(rows, kTaps);
  Eigen::VectorXd lag = Eigen::VectorXd::Zero(rows);
  Eigen::Index row = 0;
  for (const AxisRecord& record : records) {
    for (auto k = static_cast<std::size_t>(kTaps); k < record.measured.size(); ++k) {
      if (!record.counts(k)) {
        continue;
      }
      const double now = record.command[k].position;
      for (Eigen::Index i = 0; i < kTaps; ++i) {
        w(row, i) = set_point_before(record, k, static_cast<std::size_t>(i) + 1) - now;
      }
      lag[row++] = record.measured[k] - now;
    }
  }
  return transposed_product(normal_inverse(w), transposed_product(w, lag));
}

std::vector<double> filtered_command(const AxisRecord& record, const Eigen::VectorXd& taps) {
  std::vector<double> positions;
  for (std::size_t k = 0; k < record.command.size(); ++k) {
    const double now = record.command[k].position;
    double sum = now;
    for (Eigen::Index i = 0; i < taps.size(); ++i) {
      sum += taps[i] * (set_point_before(record, k, static_cast<std::size_t>(i) + 1) - now);
    }
    positions.push_back(sum);
  }
  return positions;
}

}  // namespace twin::studies::identify
