#include "studies/compensate/compensate.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "studies/compensate/model_run.hpp"

namespace twin::studies::compensate {
namespace {

constexpr double kGain = 0.8;       // of the first step
constexpr double kGrown = 1.25;     // of the least cost: go back
constexpr int kPatience = 9;        // iterations without a better one, after which it ends
constexpr std::size_t kAbout = 40;  // half width of the mean of a gain [periods]
constexpr double kLittle = 0.995;   // of the cost before: as good as no progress
constexpr double kBeyond = 1.7;     // times what is trusted, up to which the model is corrected
constexpr int kHoldings = 12;       // times that offsets are held and found anew

/// On the model itself the response is right far beyond where other machines may differ; what is
/// corrected there is at worst wrong by as much as it was.
double cut_off_of(const AxisResponse& response, const config::MachineFile& machine) {
  return std::min(kBeyond * response.trusted, machine.compensation.highest_frequency);
}

std::vector<double> squares_of(std::span<const double> values) {
  std::vector<double> squares(values.size());
  std::ranges::transform(values, squares.begin(), [](double x) { return x * x; });
  return squares;
}

/// What the iteration makes small: both figures count the same.
double cost_of(const results::ErrorStats& now, const results::ErrorStats& first) {
  const auto share = [](double a, double b) { return b > 0.0 ? a / b : 0.0; };
  return share(now.max, first.max) + share(now.rms, first.rms);
}

/// Mean over a window about each place; at the ends over what there is of it.
std::vector<double> moving_mean(std::span<const double> values, std::size_t half) {
  std::vector<double> sums(values.size() + 1, 0.0);
  std::partial_sum(values.begin(), values.end(), sums.begin() + 1);
  std::vector<double> means(values.size());
  for (std::size_t k = 0; k < values.size(); ++k) {
    const std::size_t from = k - std::min(half, k);
    const std::size_t to = std::min(k + half + 1, values.size());
    means[k] = (sums[to] - sums[from]) / static_cast<double>(to - from);
  }
  return means;
}

/// Share of the errors that is undone, place by place.
///
/// Where an axis hugs the edge of a count, a little more offset moves it to the other edge, and the
/// error turns round from run to run. There the share is halved, so that it comes to rest between.
class LocalGain {
 public:
  explicit LocalGain(std::size_t periods) : gains_(periods, kGain) {}

  void halve() {
    for (double& gain : gains_) {
      gain *= 0.5;
    }
  }
  /// Halves where errors have turned round, and grows elsewhere. @param before  may be empty
  void adapt(std::span<const Vec2> before, std::span<const Vec2> now) {
    if (before.empty()) {
      return;
    }
    std::vector<double> turned(now.size());
    std::vector<double> sizes(now.size());
    for (std::size_t k = 0; k < now.size(); ++k) {
      turned[k] = std::max(-before[k].dot(now[k]), 0.0);
      sizes[k] = before[k].squaredNorm() + 1e-12;
    }
    const std::vector<double> turned_about = moving_mean(turned, kAbout);
    const std::vector<double> sizes_about = moving_mean(sizes, kAbout);
    for (std::size_t k = 0; k < now.size(); ++k) {
      const double share = std::min(turned_about[k] / sizes_about[k], 1.0);
      gains_[k] = std::min(kGain, gains_[k] * (1.15 - 0.65 * std::min(2.0 * share, 1.0)));
    }
  }
  std::vector<Vec2> share_of(std::span<const Vec2> errors) const {
    std::vector<Vec2> share(errors.begin(), errors.end());
    for (std::size_t k = 0; k < share.size(); ++k) {
      share[k] *= gains_[k];
    }
    return share;
  }

 private:
  std::vector<double> gains_;
};

}  // namespace

OffsetLearner::OffsetLearner(const config::MachineFile& machine, const ContourPath& path)
    : responses_{axis_response(machine, 0, machine.compensation.highest_frequency),
                 axis_response(machine, 1, machine.compensation.highest_frequency)},
      cut_off_{cut_off_of(responses_[0], machine), cut_off_of(responses_[1], machine)},
      solver_(path.points(), machine.period, {responses_[0].filter, responses_[1].filter},
              cut_off_),
      audit_(path.points(), {machine.limits, machine.compensation.limit, machine.period}) {}

bool OffsetLearner::learn(std::span<const Vec2> errors, std::vector<Vec2>& offsets) {
  solver_.note_corners(errors);
  solver_.relax();
  std::vector<Vec2> improved;
  for (int round = 0; round < kHoldings; ++round) {
    improved = offsets;
    solver_.improve(errors, improved);
    audit_.clamp(improved);
    const Excess excess = audit_.excess(improved);
    if (excess.is_kept) {
      break;
    }
    solver_.hold(squares_of(excess.tangential), squares_of(excess.normal));
  }
  offsets = std::move(improved);
  return audit_.mend(offsets);
}

Expected<Compensation> compensate(const config::MachineFile& machine, const ContourPath& path,
                                  const CompensateOptions& options) {
  Compensation best;
  best.offsets.assign(path.points().size(), Vec2::Zero());
  if (best.offsets.empty()) {
    return best;
  }
  OffsetLearner learner(machine, path);
  best.cut_off = learner.cut_off();
  LocalGain gain(best.offsets.size());
  std::vector<Vec2> offsets = best.offsets;
  std::vector<Vec2> errors;
  std::vector<Vec2> best_errors;
  double least = 0.0;
  int since_best = 0;
  for (int i = 0; i <= options.most_iterations && since_best < kPatience; ++i) {
    if (options.stop != nullptr && options.stop->load()) {
      return fail(ErrorCode::kInterrupted, "interrupted");
    }
    ModelRun mean = mean_run(machine, path.points(), offsets, options.runs);
    for (std::size_t k = 0; k < options.mismatch.size(); ++k) {
      mean.table[k] += options.mismatch[k];
    }
    if (mean.has_failed && i == 0) {
      return fail(ErrorCode::kMachine,
                  "the model's position loop is unstable: nothing can be corrected on it");
    }
    std::vector<Vec2> now = path.errors(mean.table);
    const results::ErrorStats stats = stats_of(now);
    best.before = i == 0 ? stats : best.before;
    const double cost = cost_of(stats, best.before);
    ++since_best;
    if (i == 0 || (!mean.has_failed && cost < least)) {
      since_best = i > 0 && cost > kLittle * least ? since_best : 0;
      least = cost;
      best.offsets = offsets;
      best.after = stats;
      best.iterations = i;
      best_errors = now;
    }
    if (mean.has_failed || cost > kGrown * least) {
      offsets = best.offsets;
      errors = best_errors;
      gain.halve();
    } else {
      gain.adapt(errors, now);
      errors = std::move(now);
    }
    best.is_within_limits = learner.learn(gain.share_of(errors), offsets) && best.is_within_limits;
    if (options.progress) {
      options.progress((i + 1.0) / (options.most_iterations + 1.0));
    }
  }
  return best;
}

}  // namespace twin::studies::compensate
