#include "studies/identify/gain_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

#include "motion/servo/axis_servo.hpp"

namespace twin::studies::identify {
namespace {

constexpr int kGains = 5;
constexpr double kRidge = 1e-14;  // what a gain that nothing shows is held to 0 by

using Row = Eigen::Matrix<double, kGains, 1>;

}  // namespace

GainFit fit_gains(std::span<const AxisRecord> records, double mm_per_s_per_volt, double period) {
  Eigen::Matrix<double, kGains, kGains> normal = Eigen::Matrix<double, kGains, kGains>::Zero();
  Row right = Row::Zero();
  double square = 0.0;
  double rows = 0.0;
  for (const AxisRecord& record : records) {
    for (std::size_t k = 1; k < record.volts.size(); ++k) {
      if (std::abs(record.volts[k]) > 0.999 * motion::kMaxVolts) {
        continue;
      }
      const motion::Reference& reference = record.command[k];
      const double error = reference.position - record.measured[k];
      const double last = record.command[k - 1].position - record.measured[k - 1];
      Row row;
      row << error, (error - last) / period, reference.velocity, reference.acceleration,
          mm_per_s_per_volt;
      const double wanted = record.volts[k] * mm_per_s_per_volt;
      normal += row * row.transpose();
      right += row * wanted;
      square += wanted * wanted;
      rows += 1.0;
    }
  }
  normal.diagonal() *= 1.0 + kRidge;
  const Row gains = normal.ldlt().solve(right);
  const double left = std::max(square - right.dot(gains), 0.0) / std::max(rows - kGains, 1.0);
  const Row sigma = (normal.inverse().diagonal() * left).cwiseSqrt();
  return {{gains[0], gains[1], gains[2], gains[3], gains[4]},
          {sigma[0], sigma[1], sigma[2], sigma[3], sigma[4]},
          std::sqrt(left) / std::abs(mm_per_s_per_volt)};
}

}  // namespace twin::studies::identify
