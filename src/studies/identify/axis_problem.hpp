#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "config/machine_file.hpp"
#include "studies/identify/axis_record.hpp"
#include "studies/identify/parameter.hpp"
#include "studies/identify/table_side.hpp"

namespace twin::studies::identify {

/// Travel of the simulated axis during a fit, so large that no limit switch is reached [mm].
inline constexpr double kFarTravel = 1e4;

/// The least-squares problem of fitting one axis: how far the simulated axis is from the recorded
/// one if both get the same drive command.
///
///   set points r, measured y --> servo --> drive command V --> simulated axis --> x
///   residual  rho = H (y - x)
///
/// If the drive command was not recorded, it is computed: the recorded controller saw the measured
/// position y_k, so its command was V_k = servo(r_k, y_k), with the gains under test. The command
/// moves the simulated drive and slide in open loop. y is the measured position, and x the
/// simulated one, which is not quantised.
///
/// The loop is not closed in the simulation for this reason: a closed loop would pass from count to
/// count at other instants than the recorded one, which makes the residual rough. In open loop the
/// residual is a smooth function of the parameters, and with the true parameters only the rounding
/// of the encoder is left.
///
/// The velocity loop of the drive keeps x near the integral of the command, so that rho shows the
/// torque that the motion needed. Effects that the model lacks would add up in x over a long
/// record. The high-pass filter H with the time constant kForgetting removes them. Rows that are left
/// out, and those in which a record that begins in motion settles, have rho = 0.
///
/// Where the model is known to lack something and the motor's force was recorded, the differences of
/// recorded and simulated force, times a weight, are residuals beside those of the position: what
/// the model lacks is then not made up for by parameters that make a wrong force.
///
/// Where the table's position was recorded beside the motor's, it makes residuals of its own (see
/// TableSide), with a weight for its finer counts. A record whose encoder is at the table is
/// compared with the table's position.
class AxisProblem {
 public:
  static constexpr double kForgetting = 0.5;  ///< time constant of H [s]
  static constexpr double kBlock = 0.25;      ///< within which residuals may be correlated [s]

  /// @param base     machine with all parameters that are not fitted; its period must be that of
  ///                 the records
  /// @param axis     the axis that the records are of
  /// @param records  one for each trace
  AxisProblem(config::MachineFile base, hal::Axis axis, std::vector<AxisRecord> records);

  /// Residuals rho of all records in use, one record after the other, after them those of the force,
  /// if it has a weight, and those of scales on the table, if there are any [mm]. They are very large if the simulated motion is unstable.
  /// @param set    the parameters to be changed
  /// @param units  their values, each scaled to 0..1 (see ParameterSet)
  Eigen::VectorXd residuals(const ParameterSet& set, std::span<const double> units) const {
    return residuals(set.with_units(base_, units));
  }
  /// The same of a machine.
  Eigen::VectorXd residuals(const config::MachineFile& machine) const;

  /// What the rounding to counts alone makes of the residuals, for several places of the counts
  /// [mm]. It is no noise: where the axis vibrates or creeps it goes on for many rows.
  std::vector<Eigen::VectorXd> rounding_errors() const;

  /// Difference y - x of one record without the filter H [mm].
  Eigen::VectorXd difference(const config::MachineFile& machine, std::size_t record) const {
    return apart(machine, record, hum_phase_[record]).position;
  }
  /// Recorded less simulated force of all records in use [N].
  Eigen::VectorXd force_difference(const config::MachineFile& machine) const;

  /// Whether a record in use has the position of the table.
  bool shows_table() const;
  /// Whether a record has, in use or not.
  bool ever_shows_table() const;
  /// RMS of the residuals of the scales, without their weight [mm]; 0 where there are none.
  double scale_rms(const config::MachineFile& machine) const;
  /// What rounding to the counts of the scales makes of it [mm]; 0 where they have none.
  double scale_rounding_rms() const;

  /// Makes the force a part of the residuals. @param weight  0: it is none [mm/N]
  void weigh_force(double weight) noexcept { force_weight_ = weight; }

  /// Sum of squared residuals of one record [mm^2].
  /// @param hum_phase  phase of the drive's hum at the begin of the record, added to that of the
  ///                   machine [rad]
  double cost(std::size_t record, double hum_phase) const;

  const config::MachineFile& base() const noexcept { return base_; }
  void set_base(const config::MachineFile& base) { base_ = base; }
  /// The records in use.
  std::span<const AxisRecord> records() const noexcept { return {records_.data(), used_}; }
  bool has_volts() const { return records().front().has_volts(); }
  bool has_force() const { return records_.front().has_force(); }
  /// All records, in use or not.
  std::span<const AxisRecord> all_records() const noexcept { return records_; }
  /// Uses the first `count` records only. At first all records are in use.
  void use(std::size_t count) noexcept;
  /// Turns the sign of the force of all records.
  void turn_force() noexcept;
  /// Puts other records of the same traces in place of these.
  void set_records(std::vector<AxisRecord> records);
  std::size_t total() const noexcept { return records_.size(); }
  hal::Axis axis() const noexcept { return axis_; }
  Eigen::Index rows() const noexcept { return rows_; }
  /// Phase of the drive's hum at the begin of each record, relative to the first record [rad].
  std::vector<double>& hum_phase() noexcept { return hum_phase_; }
  const std::vector<double>& hum_phase() const noexcept { return hum_phase_; }

 private:
  /// How far the recorded motion and the simulated one are apart.
  struct Apart {
    Eigen::VectorXd position;  // y - x [mm]
    Eigen::VectorXd force;     // recorded less simulated, 0 where none was recorded [N]
    Eigen::VectorXd scale;     // recorded less simulated position of the table, the same [mm]
  };
  /// A record's side of the table, and the count of its scale.
  struct Table {
    TableSide side;
    double count = 0.0;  // of the scale [mm]; 0: none
  };
  Apart apart(const config::MachineFile& machine, std::size_t record, double hum_phase) const;
  void make_tables();
  void take(Eigen::Ref<Eigen::VectorXd> position, std::size_t record) const;
  Eigen::Index size() const noexcept;  // of all residuals
  Eigen::Index scales_begin() const noexcept { return force_weight_ > 0.0 ? 2 * rows_ : rows_; }

  config::MachineFile base_;
  hal::Axis axis_;
  std::vector<AxisRecord> records_;
  std::vector<double> hum_phase_;
  std::size_t used_ = 0;
  Eigen::Index rows_ = 0;      // of the records in use
  double force_weight_ = 0.0;  // [mm/N]
  std::vector<Table> tables_;  // of the records
  bool has_scale_ = false;     // any record in use
  double scale_weight_ = 1.0;
};

}  // namespace twin::studies::identify
