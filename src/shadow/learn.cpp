#include "shadow/learn.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/row_algebra.hpp"
#include "shadow/evidence.hpp"
#include "shadow/whitener.hpp"

namespace twin::shadow {
namespace {

constexpr std::size_t kPeriodsPerCoefficient = 30;  // of motion, at least
constexpr double kFloor = 1e-6;                     // white noise added to keep the filter tame
constexpr int kRounds = 2;
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

/// Calls f(row, k) for the whitened rows of the motion.
template <class F>
void for_white(const std::vector<ChannelSeries>& all, const ChannelBaseline& baseline, F&& f) {
  for (std::size_t s = 0; s < all.size(); ++s) {
    Whitener whitener(baseline.coefficients, is_differenced(baseline.kind));
    SignalRow white;
    for (std::size_t k = 0; k < all[s].rows.size(); ++k) {
      if (whitener.step(all[s].rows[k], white) && all[s].moves[k] != 0) {
        f(white, s, k);
      }
    }
  }
}

/// Means of the parameters by least squares, and the variance of the noise that they leave.
void fit_means(const std::vector<ChannelSeries>& all, const PerParameter& known,
               ChannelBaseline& baseline) {
  SquareMatrix<kParameters> normal{};
  PerParameter right{};
  double square = 0.0;
  double count = 0.0;
  for_white(all, baseline, [&](const SignalRow& white, std::size_t, std::size_t) {
    for (std::size_t i = 0; i < kParameters; ++i) {
      right[i] += white.signature[i] * white.residual;
      for (std::size_t j = 0; j <= i; ++j) {
        normal[i][j] += white.signature[i] * white.signature[j];
      }
    }
    square += white.residual * white.residual;
    count += 1.0;
  });
  const double variance = std::max(square / std::max(count, 1.0), 1e-12);
  for (std::size_t i = 0; i < kParameters; ++i) {
    normal[i][i] += variance / (known[i] * known[i]);
  }
  // What is known before makes it positive definite.
  baseline.mean = solve_in_place(normal, right, kParameters) ? right : PerParameter{};
  double left = 0.0;
  for_white(all, baseline, [&](const SignalRow& white, std::size_t, std::size_t) {
    double e = white.residual;
    for (std::size_t i = 0; i < kParameters; ++i) {
      e -= baseline.mean[i] * white.signature[i];
    }
    left += e * e;
  });
  baseline.variance = std::max(left / std::max(count, 1.0), 1e-12);
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
void fit_spreads(const std::vector<ChannelSeries>& all, double step,
                 const std::vector<double>& force_response, std::size_t moving,
                 ChannelBaseline& baseline) {
  std::array<Scores, kParameters> scores;
  baseline.windows = 0;
  double step_gain = 0.0;
  double force_gain = 0.0;
  baseline.excess.fill(1.0);
  baseline.scatter.fill(0.0);
  for (const ChannelSeries& series : all) {
    Whitener whitener(baseline.coefficients, is_differenced(baseline.kind));
    Evidence evidence(baseline, shapes_of(whitener, step, force_response));
    std::vector<Evidence::Block> blocks;
    SignalRow white;
    for (std::size_t k = 0; k < series.rows.size(); ++k) {
      const bool is_full = whitener.step(series.rows[k], white);
      if (!is_full || series.moves[k] == 0) {
        evidence.interrupt();
        continue;
      }
      if (evidence.add(white, series.direction[k], series.counts[k],
                       {.time = static_cast<double>(k) * 1e-3})) {
        blocks.push_back(evidence.blocks().back());
      }
    }
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
            scores[i].square.push_back(fit.explained / baseline.variance);
            scores[i].information.push_back(sum.information[i] / baseline.variance);
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

}  // namespace

Expected<ChannelBaseline> learn_channel(ChannelKind kind, const std::vector<ChannelSeries>& series,
                                        const PerParameter& known, const PerParameter& limit,
                                        double step, const std::vector<double>& force_response) {
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
  for (int round = 0; round < kRounds; ++round) {
    baseline.coefficients =
        autoregression(covariance_of(series, order, is_differenced(kind), baseline.mean));
    fit_means(series, known, baseline);
  }
  fit_spreads(series, step, force_response, moving, baseline);
  return baseline;
}

}  // namespace twin::shadow
