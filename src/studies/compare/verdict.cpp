#include "studies/compare/verdict.hpp"

#include <fmt/format.h>

#include <string_view>

namespace twin::studies::compare {
namespace {

constexpr double kDoubt = 1.05;
constexpr double kExact = 1.001;

/// The worst of the shares that passes what it may be.
class Worst {
 public:
  void see(std::string_view name, double value, double limit, double allowed) {
    const double share = limit > 0.0 ? value / limit : 0.0;
    if (share > allowed && share > share_) {
      name_ = name;
      share_ = share;
    }
  }

  std::string text() const {
    return share_ > 0.0 ? fmt::format("{} {:.2f}", name_, share_) : "kept";
  }

 private:
  std::string_view name_;
  double share_ = 0.0;
};

}  // namespace

std::string audit_verdict(const results::AuditPeaks& peaks, const Limits& limits) {
  Worst worst;
  worst.see("feedrate", peaks.feedrate, limits.feedrate, kExact);
  worst.see("acceleration", peaks.tangential_acceleration, limits.acceleration, kDoubt);
  worst.see("normal", peaks.normal_acceleration, limits.acceleration, kDoubt);
  worst.see("jerk", peaks.tangential_jerk, limits.jerk, kDoubt);
  for (std::size_t i = 0; i < peaks.axis.size(); ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    worst.see("axis feedrate", peaks.axis[i].velocity, limits.axis_feedrate[axis], kExact);
    worst.see("axis acceleration", peaks.axis[i].acceleration, limits.axis_acceleration[axis],
              kExact);
    worst.see("axis jerk", peaks.axis[i].jerk, limits.axis_jerk[axis], kExact);
  }
  return worst.text();
}

}  // namespace twin::studies::compare
