#include "tests/fuzz/chain/distance_check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace twin::fuzz {
namespace {

constexpr double kTextRounding = 1e-6;  // of the text's numbers [mm]

/// A straight piece of the programmed path.
struct Chord {
  Vec3 from;
  Vec3 to;
  double allowed;  // distance from it [mm]
};

double distance_to(const Vec3& p, const Vec3& from, const Vec3& to) {
  const Vec3 way = to - from;
  const double square = way.squaredNorm();
  const double along = square > 0.0 ? std::clamp((p - from).dot(way) / square, 0.0, 1.0) : 0.0;
  return (p - from - along * way).norm();
}

/// How far the path may be off each block [mm].
std::vector<double> allowances(const Case& made) {
  const config::MachineFile& machine = made.machine;
  const double usual = machine.path.planner == Planner::kPaper ? machine.path.chord_error
                                                               : machine.planning.corner_error;
  const std::vector<Piece>& pieces = made.program.pieces;
  std::vector<double> own;
  for (const Piece& piece : pieces) {
    own.push_back(piece.is_exact ? 0.0 : piece.tolerance > 0.0 ? piece.tolerance : usual);
  }
  std::vector<double> allowed;
  for (std::size_t i = 0; i < own.size(); ++i) {
    const double around =
        std::max({own[i > 0 ? i - 1 : 0], own[i], own[std::min(i + 1, own.size() - 1)]});
    allowed.push_back(around + pieces[i].shape.slack + kTextRounding);
  }
  return allowed;
}

std::vector<Chord> chords_of(const Case& made, const std::vector<double>& allowed) {
  std::vector<Chord> chords;
  for (std::size_t i = 0; i < allowed.size(); ++i) {
    const std::vector<Vec3>& points = made.program.pieces[i].shape.points;
    chords.push_back({points.front(), points.front(), allowed[i]});
    for (std::size_t k = 1; k < points.size(); ++k) {
      chords.push_back({points[k - 1], points[k], allowed[i]});
    }
  }
  return chords;
}

/// The chord that is nearest to a point, as share of what is allowed, among some.
std::pair<double, std::size_t> nearest(const std::vector<Chord>& chords, const Vec3& point,
                                       std::size_t from, std::size_t to) {
  std::pair<double, std::size_t> best{std::numeric_limits<double>::infinity(), from};
  for (std::size_t i = from; i < std::min(to, chords.size()); ++i) {
    const double share = distance_to(point, chords[i].from, chords[i].to) / chords[i].allowed;
    best = std::min(best, {share, i});
  }
  return best;
}

/// Whether the set points pass the end of each block, one after the other.
bool passes_all(const Case& made, const Trajectory& trajectory,
                const std::vector<double>& allowed) {
  // Between two set points the path is off the chord by what the acceleration allows.
  const double sagitta = 0.5 * made.machine.limits.acceleration * std::pow(made.machine.period, 2);
  const std::vector<Vec3>& points = trajectory.points;
  std::size_t at = 0;
  for (std::size_t i = 0; i < allowed.size(); ++i) {
    const Vec3& end = made.program.pieces[i].shape.points.back();
    const auto is_near = [&] {
      return distance_to(end, points[at], points[std::min(at + 1, points.size() - 1)]) <=
             allowed[i] + sagitta;
    };
    while (at < points.size() && !is_near()) {
      ++at;
    }
    if (at == points.size()) {
      return false;
    }
  }
  return true;
}

}  // namespace

void measure_distance(const Case& made, const Trajectory& trajectory, Shares& shares) {
  constexpr std::size_t kBack = 3;
  constexpr std::size_t kAhead = 12;
  const std::vector<double> allowed = allowances(made);
  const std::vector<Chord> chords = chords_of(made, allowed);
  double largest = 0.0;
  std::size_t at = 0;
  for (const Vec3& point : trajectory.points) {
    auto found = nearest(chords, point, at > kBack ? at - kBack : 0, at + kAhead);
    if (found.first > 1.0) {
      found = nearest(chords, point, 0, chords.size());
    }
    largest = std::max(largest, found.first);
    at = found.second;
  }
  share_of(shares, Measure::kDistance) = largest;
  // A parameter that is not corrected runs past the end of a curve, or not up to it.
  const bool is_exact = made.machine.interpolation.update == motion::ParameterUpdate::kCorrected;
  if (is_exact && trajectory.ending == Ending::kWhole) {
    share_of(shares, Measure::kPassed) = passes_all(made, trajectory, allowed) ? 0.0 : 2.0;
  }
}

}  // namespace twin::fuzz
