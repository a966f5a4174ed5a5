#include "studies/compensate/model_run.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/parallel_for.hpp"
#include "motion/correction/correction_follower.hpp"
#include "studies/identify/axis_model.hpp"

namespace twin::studies::compensate {
namespace {

/// One axis of a run: its positions in every period.
struct AxisTrack {
  std::vector<double> table;
  std::vector<double> encoder;
  bool has_failed = false;
};

AxisTrack run_axis(const identify::AxisSetup& setup, std::span<const motion::Reference> references,
                   double first_offset) {
  AxisTrack track;
  if (references.empty()) {
    return track;
  }
  track.table.reserve(references.size());
  track.encoder.reserve(references.size());
  const double start = references.front().position - first_offset;
  identify::AxisModel model(setup, start);
  const long periods = std::lround(identify::kSettleTime / setup.period);
  for (long i = 0; i < periods; ++i) {
    const double share = motion::share_at_rest(static_cast<double>(i + 1) * setup.period);
    model.follow({start + share * first_offset, 0.0, 0.0});
  }
  for (const motion::Reference& reference : references) {
    const identify::AxisRow row = model.follow(reference);
    track.table.push_back(row.table);
    track.encoder.push_back(row.encoder);
  }
  track.has_failed = model.has_failed();
  return track;
}

identify::AxisSetup setup_of(const config::MachineFile& machine, std::size_t axis,
                             const Phases& phases) {
  identify::AxisSetup setup = identify::axis_setup(machine, axis == 0 ? hal::kX : hal::kY);
  setup.axis.encoder.phase = phases.encoder[axis];
  setup.axis.drive.hum_phase = phases.hum[axis];
  return setup;
}

/// Adds a share of one axis' track to a run.
void add(const AxisTrack& track, Eigen::Index axis, double share, ModelRun& run) {
  for (std::size_t k = 0; k < track.table.size(); ++k) {
    run.table[k][axis] += share * track.table[k];
    run.encoder[k][axis] += share * track.encoder[k];
  }
  run.has_failed = run.has_failed || track.has_failed;
}

/// A step that visits all of `count` places and leaves neighbours far apart: coprime to the count and
/// next to its golden section.
std::size_t mixing_step(std::size_t count) {
  auto step = static_cast<std::size_t>(std::lround(0.618 * static_cast<double>(count)));
  while (step > 1 && std::gcd(step, count) != 1) {
    --step;
  }
  return std::max<std::size_t>(step, 1);
}

}  // namespace

Phases even_phases(std::size_t index, std::size_t count, double shift) {
  const auto share = [&](std::size_t place) {
    const double turn = (static_cast<double>(place % count) + shift) / static_cast<double>(count);
    return turn - std::floor(turn);
  };
  const std::size_t mixed = index * mixing_step(count);
  Phases phases;
  phases.hum = {2.0 * std::numbers::pi * share(index), 2.0 * std::numbers::pi * share(mixed)};
  phases.encoder = {share(mixed + count / 2), share(index + count / 2)};
  return phases;
}

std::vector<motion::Reference> corrected_references(std::span<const motion::SetPoint> points,
                                                    std::span<const Vec2> offsets, std::size_t axis,
                                                    double period) {
  const auto k = static_cast<Eigen::Index>(axis);
  std::vector<motion::Reference> references(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const motion::SetPoint& point = points[i];
    references[i] = {point.position[k], point.velocity[k], point.acceleration[k]};
    if (!offsets.empty()) {
      const double before = offsets[i == 0 ? 0 : i - 1][k];
      const double here = offsets[i][k];
      const double after = offsets[std::min(i + 1, points.size() - 1)][k];
      references[i].position += here;
      references[i].velocity += (after - before) / (2.0 * period);
      references[i].acceleration += (after - 2.0 * here + before) / (period * period);
    }
  }
  return references;
}

ModelRun run_model(const config::MachineFile& machine, std::span<const motion::SetPoint> points,
                   std::span<const Vec2> offsets, const Phases& phases) {
  ModelRun run;
  run.table.assign(points.size(), Vec2::Zero());
  run.encoder.assign(points.size(), Vec2::Zero());
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const auto k = static_cast<Eigen::Index>(axis);
    const double first = offsets.empty() ? 0.0 : offsets.front()[k];
    add(run_axis(setup_of(machine, axis, phases),
                 corrected_references(points, offsets, axis, machine.period), first),
        k, 1.0, run);
  }
  return run;
}

ModelRun mean_run(const config::MachineFile& machine, std::span<const motion::SetPoint> points,
                  std::span<const Vec2> offsets, std::size_t runs, double shift) {
  ModelRun mean;
  mean.table.assign(points.size(), Vec2::Zero());
  mean.encoder.assign(points.size(), Vec2::Zero());
  std::vector<AxisTrack> tracks(2 * runs);
  std::array<std::vector<motion::Reference>, 2> references;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    references[axis] = corrected_references(points, offsets, axis, machine.period);
  }
  parallel_for(2 * runs, [&](std::size_t job) {
    const std::size_t axis = job % 2;
    const Phases phases = even_phases(job / 2, runs, shift);
    const double first = offsets.empty() ? 0.0 : offsets.front()[static_cast<Eigen::Index>(axis)];
    tracks[job] = run_axis(setup_of(machine, axis, phases), references[axis], first);
  });
  for (std::size_t job = 0; job < 2 * runs; ++job) {
    add(tracks[job], static_cast<Eigen::Index>(job % 2), 1.0 / static_cast<double>(runs), mean);
  }
  return mean;
}

}  // namespace twin::studies::compensate
