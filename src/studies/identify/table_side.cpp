#include "studies/identify/table_side.hpp"

#include <algorithm>
#include <cmath>

namespace twin::studies::identify {
namespace {

using Eigen::Index;

constexpr std::size_t kReach = 4;  // of a difference either way: counts make little of it [rows]

/// The first row from which on the nut stands at a flank that is known.
std::size_t first_row(const AxisRecord& record, double period) {
  const auto& y = record.measured;
  std::size_t row = settling_rows(record, period);
  while (row < y.size() && std::abs(y[row] - y.front()) < TableSide::kFirstWay) {
    ++row;
  }
  return row;
}

}  // namespace

double measured_velocity(const AxisRecord& record, std::size_t row, double period) {
  const std::size_t before = row - std::min(row, kReach);
  const std::size_t after = std::min(row + kReach, record.measured.size() - 1);
  return (record.measured[after] - record.measured[before]) /
         (static_cast<double>(std::max<std::size_t>(after - before, 1)) * period);
}

void drop_slow(Eigen::Ref<Eigen::VectorXd> values, const AxisRecord& record, double period,
               double time_constant, std::size_t first) {
  const double keep = std::exp(-period / time_constant);
  const auto settling = static_cast<Index>(first);
  double last = settling < values.size() ? values[settling] : 0.0;
  double filtered = 0.0;
  for (Index k = 0; k < values.size(); ++k) {
    if (k < settling) {
      values[k] = 0.0;
      continue;
    }
    if (!record.counts(static_cast<std::size_t>(k))) {
      values[k] = 0.0;
      continue;
    }
    filtered = keep * (filtered + values[k] - last);
    last = values[k];
    values[k] = filtered;
  }
}

TableSide::TableSide(const AxisRecord& record, double period, double time_constant,
                     bool takes_shares_off)
    : period_(period), time_constant_(time_constant), first_(first_row(record, period)) {
  const auto rows = static_cast<Index>(record.measured.size());
  if (!takes_shares_off) {
    return;
  }
  shares_.resize(rows, 2);
  for (Index k = 0; k < rows; ++k) {
    shares_(k, 0) = record.measured[static_cast<std::size_t>(k)];
    shares_(k, 1) = measured_velocity(record, static_cast<std::size_t>(k), period);
  }
  for (Index i = 0; i < 2; ++i) {
    drop_slow(shares_.col(i), record, period_, time_constant_, first_);
  }
  for (Index i = 0; i < 2; ++i) {
    if (i == 1) {
      shares_.col(1) -= shares_.col(0) * shares_.col(0).dot(shares_.col(1));
    }
    const double norm = shares_.col(i).norm();
    shares_.col(i) /= std::max(norm, 1e-12);
  }
}

void TableSide::take(Eigen::Ref<Eigen::VectorXd> apart, const AxisRecord& record) const {
  drop_slow(apart, record, period_, time_constant_, first_);
  for (Index i = 0; i < shares_.cols(); ++i) {
    apart -= shares_.col(i) * shares_.col(i).dot(apart);
  }
}

}  // namespace twin::studies::identify
