#include "shadow/learn.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/row_algebra.hpp"
#include "core/stop_wish.hpp"
#include "shadow/channel_filter.hpp"
#include "shadow/evidence.hpp"
#include "shadow/whitener.hpp"

namespace twin::shadow {
namespace {

constexpr std::size_t kPeriodsPerCoefficient = 30;  // of motion, at least
constexpr double kFloor = 1e-6;                     // white noise added to keep the filter tame
constexpr const char* kInterrupted = "interrupted: nothing is learnt";
constexpr int kRounds = 2;
constexpr int kRoundsOfCounts = 3;  // slopes are of the first order, so that they come step by step
/// Noise of counts, in counts: what the search begins with, and its limits.
constexpr double kFirstNoise = 0.02;
constexpr double kLeastNoise = 1e-4;
constexpr double kMostNoise = 10.0;
/// Periods that it is found from, of all recordings and at least of each.
constexpr std::size_t kNoisePeriods = 40000;
constexpr std::size_t kLeastNoisePeriods = 2000;
/// Periods of motion after which precisions are compared.
constexpr double kPeriodsOfPrecision = 1000.0;
/// Windows over which scores are taken, in blocks of Evidence.
constexpr std::array<std::size_t, 3> kWindows{5, 20, 80};
/// Motion below which the shortest windows are shorter, so that there are some [periods].
constexpr std::size_t kShortMotion = 5000;
constexpr std::size_t kShortestWindow = 2;

double value_at(const ChannelSeries& series, std::size_t k, const PerParameter& mean) {
  double value = series.rows[k].residual;
  for (std::size_t i = 0; i < kParameters; ++i) {
    value -= mean[i] * series.rows[k].signature[i];
  }
  return value;
}

/// Autocovariance of the increments, or of the values, where the axis moves.
std::vector<double> covariance_of(const std::vector<ChannelSeries>& all, std::size_t order,
                                  bool is_differenced, const PerParameter& mean) {
  std::vector<double> covariance(order + 1, 0.0);
  std::vector<double> values;
  double count = 0.0;
  for (const ChannelSeries& series : all) {
    values.assign(series.rows.size(), 0.0);
    const std::size_t first = is_differenced ? 1 : 0;
    for (std::size_t k = first; k < values.size(); ++k) {
      values[k] =
          value_at(series, k, mean) - (is_differenced ? value_at(series, k - 1, mean) : 0.0);
    }
    for (std::size_t k = 0; k < values.size(); ++k) {
      if (series.moves[k] == 0) {
        values[k] = 0.0;  // so the covariances stay those of one sequence, and the filter stable
        continue;
      }
      count += 1.0;
      for (std::size_t j = 0; j <= std::min(order, k); ++j) {
        covariance[j] += values[k] * values[k - j];
      }
    }
  }
  for (double& c : covariance) {
    c /= std::max(count, 1.0);
  }
  covariance[0] *= 1.0 + kFloor;
  return covariance;
}

/// Calls f(row) for the rows of the motion. No counts are taken for lost: the machine is healthy, and
/// what the model does not have yet looks like that.
template <class F>
void for_rows(const std::vector<ChannelSeries>& all, const ChannelBaseline& baseline,
              const ChannelFacts& facts, F&& f) {
  for (const ChannelSeries& series : all) {
    ChannelFilter filter(baseline, facts);
    for (std::size_t k = 0; k < series.rows.size(); ++k) {
      const ChannelFilter::Output output = filter.step(
          series.rows[k], series.moves[k] != 0, series.direction[k], 0.0, series.is_slow[k] != 0);
      if (output.has_row) {
        f(output.row);
      }
    }
  }
}

/// Noise of the counts, by the likelihood of all of them: one of them is made larger or smaller by
/// a factor in turn as long as that helps, and the factor smaller. It ends early once `stop` is set.
void fit_noise(const std::vector<ChannelSeries>& all, const ChannelFacts& facts,
               const std::atomic<bool>* stop, ChannelBaseline& baseline) {
  const std::size_t periods = std::max(kNoisePeriods / all.size(), kLeastNoisePeriods);
  const ChannelFilter means(baseline, facts);
  const auto likelihood = [&](const CountNoise& noise) {
    double sum = 0.0;
    for (const ChannelSeries& series : all) {
      CountFilter filter(facts.count, noise, facts.hum_angle, 0);
      for (std::size_t k = 0; k < std::min(periods, series.rows.size()); ++k) {
        if (series.moves[k] == 0) {
          filter.interrupt();
        } else {
          const double loose = series.is_slow[k] != 0 ? noise.slow : 0.0;
          sum += filter.step(means.healthy(series.rows[k]), 0.0, loose).log_likelihood;
        }
      }
    }
    return sum;
  };
  double best = likelihood(baseline.noise);
  for (double factor = 4.0; factor > 1.2; factor = std::sqrt(factor)) {
    for (bool has_moved = true; has_moved && check_wish(stop, kInterrupted);) {
      has_moved = false;
      for (double CountNoise::*which : {&CountNoise::walk, &CountNoise::white, &CountNoise::slow}) {
        for (const double by : {factor, 1.0 / factor}) {
          CountNoise noise = baseline.noise;
          noise.*which =
              std::clamp(noise.*which * by, kLeastNoise * facts.count, kMostNoise * facts.count);
          const double here = likelihood(noise);
          if (here > best) {
            best = here;
            baseline.noise = noise;
            has_moved = true;
            break;
          }
        }
      }
    }
  }
}

/// Means of the parameters by least squares, added to those that are there.
void fit_means(const std::vector<ChannelSeries>& all, const PerParameter& known,
               const ChannelFacts& facts, ChannelBaseline& baseline) {
  SquareMatrix<kParameters> normal{};
  PerParameter right{};
  for_rows(all, baseline, facts, [&](const WhiteRow& row) {
    for (std::size_t i = 0; i < kParameters; ++i) {
      right[i] += row.signature[i] * row.score;
      for (std::size_t j = 0; j <= i; ++j) {
        normal[i][j] += row.weight * row.signature[i] * row.signature[j];
      }
    }
  });
  for (std::size_t i = 0; i < kParameters; ++i) {
    const double weight = 1.0 / (known[i] * known[i]);
    normal[i][i] += weight;
    right[i] -= weight * baseline.mean[i];
  }
  // What is known before makes it positive definite.
  if (solve_in_place(normal, right, kParameters)) {
    for (std::size_t i = 0; i < kParameters; ++i) {
      baseline.mean[i] += right[i];
    }
  }
}

/// Variance of the noise that the means leave, of a whitened residual.
void fit_variance(const std::vector<ChannelSeries>& all, const ChannelFacts& facts,
                  ChannelBaseline& baseline) {
  double square = 0.0;
  double count = 0.0;
  for_rows(all, baseline, facts, [&](const WhiteRow& row) {
    square += row.score * row.score / (row.weight * row.weight);
    count += 1.0;
  });
  baseline.variance = std::max(square / std::max(count, 1.0), 1e-12);
}

/// Squares of scores and informations of one parameter over windows.
struct Scores {
  std::vector<double> square;       // h^2 / (G s^2)
  std::vector<double> information;  // G / s^2
};

/// Fits E[h^2 / (G s^2)] = q + t^2 G / s^2, then widens both so that the largest of the n values is
/// no larger than the largest of n is likely to be.
void fit_spread(const Scores& scores, double& excess, double& scatter) {
  const std::size_t n = scores.square.size();
  excess = 1.0;
  scatter = 0.0;
  if (n == 0) {
    return;
  }
  // Each window counts as its value is large: weights 1 / (q + t^2 G / s^2)^2, found in rounds.
  double q = 1.0;
  double t2 = 0.0;
  for (int round = 0; round < 20; ++round) {
    double s0 = 0.0, s1 = 0.0, s2 = 0.0, r0 = 0.0, r1 = 0.0;
    for (std::size_t k = 0; k < n; ++k) {
      const double g = scores.information[k];
      const double expected = q + t2 * g;
      const double w = 1.0 / (expected * expected);
      s0 += w;
      s1 += w * g;
      s2 += w * g * g;
      r0 += w * scores.square[k];
      r1 += w * g * scores.square[k];
    }
    const double det = s0 * s2 - s1 * s1;
    double slope = det > 1e-12 * s0 * s2 ? (s0 * r1 - s1 * r0) / det : 0.0;
    double level = s0 > 0.0 ? (r0 - slope * s1) / s0 : 1.0;
    if (level < 1.0) {
      level = 1.0;
      slope = s2 > 0.0 ? (r1 - s1) / s2 : 0.0;
    }
    t2 = std::max(slope, 0.0);
    q = std::max(slope < 0.0 ? r0 / s0 : level, 1.0);
  }
  double largest = 0.0;
  for (std::size_t k = 0; k < n; ++k) {
    largest = std::max(largest, scores.square[k] / (q + t2 * scores.information[k]));
  }
  const double likely = 2.0 * std::log(static_cast<double>(n)) + 2.0;
  const double widened = std::max(largest / likely, 1.0);
  excess = q * widened;
  scatter = std::sqrt(t2 * widened);
}

/// Learns excess and scatter from the blocks of each recording.
void fit_spreads(const std::vector<ChannelSeries>& all, const ChannelFacts& facts,
                 std::size_t moving, ChannelBaseline& baseline) {
  std::array<Scores, kParameters> scores;
  baseline.windows = 0;
  double step_gain = 0.0;
  double force_gain = 0.0;
  baseline.excess.fill(1.0);
  baseline.scatter.fill(0.0);
  for (const ChannelSeries& series : all) {
    ChannelFilter filter(baseline, facts);
    Evidence evidence(baseline, series.rows.size() / Evidence::kBlock + 2);
    for (std::size_t k = 0; k < series.rows.size(); ++k) {
      const ChannelFilter::Output output =
          filter.step(series.rows[k], series.moves[k] != 0, series.direction[k], series.heading[k],
                      series.is_slow[k] != 0);
      if (output.has_row) {
        evidence.add(output, filter, series.counts[k], {.time = static_cast<double>(k) * 1e-3});
      }
    }
    const std::vector<Evidence::Block>& blocks = evidence.blocks();
    for (std::size_t length : kWindows) {
      const bool is_shortest = length == kWindows.front();
      length = is_shortest && moving < kShortMotion ? kShortestWindow : length;
      for (std::size_t first = 0; first + length <= blocks.size(); first += length) {
        Evidence::Block sum;
        for (std::size_t b = first; b < first + length; ++b) {
          sum.steps += blocks[b].steps;
          sum.force.gain = std::max(sum.force.gain, blocks[b].force.gain);
          for (std::size_t i = 0; i < kParameters; ++i) {
            sum.score[i] += blocks[b].score[i];
            sum.information[i] += blocks[b].information[i];
          }
        }
        baseline.windows += is_shortest ? 1 : 0;
        step_gain = std::max(step_gain, sum.steps);
        force_gain = std::max(force_gain, sum.force.gain);
        for (std::size_t i = 0; i < kParameters; ++i) {
          if (sum.information[i] > 0.0) {
            const Fitted fit = fitted(sum.score[i], sum.information[i], baseline.limit[i]);
            scores[i].square.push_back(fit.explained);
            scores[i].information.push_back(sum.information[i]);
          }
        }
      }
    }
  }
  // Gains of white noise pay for their time, so the largest of n windows is about 2 ln n.
  const double likely = 2.0 * std::log(std::max(static_cast<double>(baseline.windows), 3.0));
  baseline.step_excess = std::max(step_gain / likely, 1.0);
  baseline.force_excess = std::max(force_gain / likely, 1.0);
  for (std::size_t i = 0; i < kParameters; ++i) {
    fit_spread(scores[i], baseline.excess[i], baseline.scatter[i]);
  }
}

/// What a second of motion tells of each parameter.
PerParameter precision_of(const std::vector<ChannelSeries>& all, const ChannelFacts& facts,
                          const ChannelBaseline& baseline) {
  PerParameter information{};
  double rows = 0.0;
  for_rows(all, baseline, facts, [&](const WhiteRow& row) {
    rows += 1.0;
    for (std::size_t i = 0; i < kParameters; ++i) {
      information[i] += row.weight * row.signature[i] * row.signature[i];
    }
  });
  for (std::size_t i = 0; i < kParameters; ++i) {
    const double g = information[i] * kPeriodsOfPrecision / std::max(rows, 1.0);
    const double t = baseline.scatter[i];
    information[i] = g > 0.0 ? g / (baseline.excess[i] + t * t * g) : 0.0;
  }
  return information;
}

}  // namespace

Expected<ChannelBaseline> learn_channel(ChannelKind kind, const std::vector<ChannelSeries>& series,
                                        const PerParameter& known, const PerParameter& limit,
                                        const ChannelFacts& facts, PerParameter* precision,
                                        const std::atomic<bool>* stop) {
  std::size_t moving = 0;
  for (const ChannelSeries& one : series) {
    moving += static_cast<std::size_t>(std::ranges::count(one.moves, char{1}));
  }
  if (moving < kLeastMotion) {
    return fail(
        ErrorCode::kFile,
        fmt::format("{} periods of motion are too few to learn from; at least {} are needed",
                    moving, kLeastMotion));
  }
  ChannelBaseline baseline;
  baseline.kind = kind;
  baseline.limit = limit;
  const std::size_t order = std::min(kLongestFilter, moving / kPeriodsPerCoefficient);
  baseline.noise = {kFirstNoise * facts.count, kFirstNoise * facts.count,
                    kFirstNoise * facts.count};
  for (int round = 0; round < (is_followed(kind) ? kRoundsOfCounts : kRounds); ++round) {
    TWIN_CHECK(check_wish(stop, kInterrupted));
    if (is_followed(kind)) {
      fit_noise(series, facts, stop, baseline);
    } else {
      baseline.coefficients =
          autoregression(covariance_of(series, order, is_differenced(kind), baseline.mean));
      fit_variance(series, facts, baseline);
    }
    fit_means(series, known, facts, baseline);
    if (!is_followed(kind)) {
      fit_variance(series, facts, baseline);
    }
  }
  TWIN_CHECK(check_wish(stop, kInterrupted));
  fit_spreads(series, facts, moving, baseline);
  if (precision != nullptr) {
    *precision = precision_of(series, facts, baseline);
  }
  return baseline;
}

}  // namespace twin::shadow
