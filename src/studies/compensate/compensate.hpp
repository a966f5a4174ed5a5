#pragma once

#include <atomic>
#include <functional>
#include <vector>

#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "results/metrics/summary.hpp"
#include "studies/compensate/contour_path.hpp"
#include "studies/compensate/loop_response.hpp"
#include "studies/compensate/offset_limits.hpp"
#include "studies/compensate/offset_solver.hpp"

/// Shifts of set points by which the measured path meets the programmed one.
namespace twin::studies::compensate {

/// How offsets are found.
struct CompensateOptions {
  int most_iterations = 24;
  std::size_t runs = 16;  ///< of the model in an iteration, each with other phases
  /// How far the machine was from where the model would have been with the same offsets, as
  /// measured (periods) [mm]; empty: nothing was measured.
  std::vector<Vec2> mismatch;
  const std::atomic<bool>* stop = nullptr;
  std::function<void(double)> progress;  ///< gets the done share, 0 to 1
};

/// Offsets that the model has found.
struct Compensation {
  std::vector<Vec2> offsets;   ///< one a period [mm]
  results::ErrorStats before;  ///< contour error of the model's table, mean of the runs [mm]
  results::ErrorStats after;   ///< the same with the offsets [mm]
  int iterations = 0;
  bool is_within_limits = true;     ///< false: nothing could be corrected within limits
  std::array<double, 2> cut_off{};  ///< up to which is learnt, of x and y [Hz]
};

/// Learns offsets from errors, run after run, whether of the model or of a machine.
class OffsetLearner {
 public:
  /// @param machine  with limits and servo of the run, not those with reserve
  /// @param path     planned for runtime::planned_with_reserve(machine); outlives the learner
  OffsetLearner(const config::MachineFile& machine, const ContourPath& path);

  /// Changes offsets by what undoes errors, within all limits.
  ///
  /// Where the set points would exceed a limit, the offsets are held there and found anew, some
  /// times; what is left then is mended.
  /// @param errors  what is to be undone: from where the machine was to the programmed path, or a
  ///                share of it [mm]
  /// @returns false if no offsets keep the limits: they are 0
  bool learn(std::span<const Vec2> errors, std::vector<Vec2>& offsets);

  /// Frequencies up to which it corrects, of x and y [Hz].
  const std::array<double, 2>& cut_off() const noexcept { return cut_off_; }

 private:
  std::array<AxisResponse, 2> responses_;
  std::array<double, 2> cut_off_;
  OffsetSolver solver_;
  OffsetAudit audit_;
};

/// Finds offsets on the model that a machine file describes.
///
/// An iteration runs the model several times with even phases, takes the mean position of the table
/// and learns from its contour error. Where the error grows, it goes back to the best offsets with
/// half the gain; the best ones are the result.
/// @param machine  with limits and servo of the run, not those with reserve
/// @param path     planned for runtime::planned_with_reserve(machine)
Expected<Compensation> compensate(const config::MachineFile& machine, const ContourPath& path,
                                  const CompensateOptions& options = {});

}  // namespace twin::studies::compensate
