#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "config/machine_file.hpp"
#include "studies/identify/axis_model.hpp"
#include "studies/identify/parameter.hpp"

namespace twin::studies::identify {

inline constexpr double kFarTravel = 1e4;  ///< limit switches play no part in a fit [mm]

/// What was recorded of one axis in one trace, a row a period.
struct AxisRecord {
  std::vector<motion::Reference> command;  ///< set points
  std::vector<double> measured;            ///< [mm]
  std::vector<double> volts;               ///< drive command [V]; empty where it was not recorded

  bool has_volts() const noexcept { return !volts.empty(); }
};

/// The simulated axis, driven by the command that drove the recorded one.
///
/// The drive command is known even where it was not recorded: the measured position is what the
/// recorded controller saw, so the command is V_k = servo(r_k, y_k) with the gains under test. This
/// command drives the simulated drive and slide in open loop. The residual is
///   rho = H (y - x),
/// where y is the measured position and x the simulated one, which is not quantised.
///
/// A loop closed in the simulation would jump by whole counts at other instants than the recorded
/// loop. In open loop the residual is a smooth function of the parameters, and with the true
/// parameters it is the rounding of the encoder alone. The integral of the drive keeps x near the
/// integral of the command, so that rho shows the torque which the motion needed. H is a high-pass
/// filter with the time constant kForgetting; it forgets what the model lacks, which would add up
/// in x.
class AxisProblem {
 public:
  static constexpr double kForgetting = 0.5;  ///< time constant of H [s]

  /// @param base  machine whose other numbers stand; its period is that of the records
  /// @param hum_phase  of each record, added to that of the machine [rad]
  AxisProblem(config::MachineFile base, hal::Axis axis, std::vector<AxisRecord> records);

  /// Residuals of all records for other parameters [mm]; very large where the motion is unstable.
  Eigen::VectorXd residuals(const ParameterSet& set, std::span<const double> units) const;

  /// y - x of one record, not filtered [mm].
  Eigen::VectorXd difference(const config::MachineFile& machine, std::size_t record) const {
    return difference(machine, record, hum_phase_[record]);
  }

  /// Sum of squared residuals of one record, with another phase of its hum [mm^2].
  double cost(std::size_t record, double hum_phase) const;

  const config::MachineFile& base() const noexcept { return base_; }
  void set_base(const config::MachineFile& base) { base_ = base; }
  /// The records in use.
  std::span<const AxisRecord> records() const noexcept { return {records_.data(), used_}; }
  bool has_volts() const { return records().front().has_volts(); }
  /// Uses the first records only; all at the beginning.
  void use(std::size_t count) noexcept;
  std::size_t total() const noexcept { return records_.size(); }
  hal::Axis axis() const noexcept { return axis_; }
  Eigen::Index rows() const noexcept { return rows_; }
  /// Phase of the hum of each record against the first [rad].
  std::vector<double>& hum_phase() noexcept { return hum_phase_; }
  const std::vector<double>& hum_phase() const noexcept { return hum_phase_; }

 private:
  Eigen::VectorXd difference(const config::MachineFile& machine, std::size_t record,
                             double hum_phase) const;

  config::MachineFile base_;
  hal::Axis axis_;
  std::vector<AxisRecord> records_;
  std::vector<double> hum_phase_;
  std::size_t used_ = 0;
  Eigen::Index rows_ = 0;  // of the records in use
};

}  // namespace twin::studies::identify
