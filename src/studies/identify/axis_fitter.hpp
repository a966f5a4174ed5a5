#pragma once

#include <string>
#include <vector>

#include "studies/identify/axis_fit.hpp"
#include "studies/identify/judge.hpp"
#include "studies/identify/lacking_features.hpp"
#include "studies/identify/parameter.hpp"

namespace twin::studies::identify {

/// The fit of one axis on its way.
class AxisFitter {
 public:
  AxisFitter(AxisProblem&& problem, FitOptions options);
  AxisFit run();

 private:
  /// A parameter that a search may fit.
  struct Searched {
    Candidate candidate;
    FittedParameter result;
    bool is_held = false;      ///< keeps its value in every search
    bool is_measured = false;  ///< by the motor's force
  };
  using Indices = std::vector<std::size_t>;  // into searched_

  bool has_volts() const { return problem_.has_volts(); }
  bool is_wanted(Candidate::When when) const;
  bool is_free(const std::string& name) const;
  void estimate_directly();
  void estimate_gains();
  void estimate_inverse();
  void fit_inverse_models();
  void add_load(const std::string& key, const char* name, double& field, double start,
                const Coefficient& coefficient, double to_unit);
  void take_loads(const InverseModel& model);
  void raise_peak_torque();
  void take_coefficient(const std::string& name, const Coefficient& coefficient, double to_unit,
                        bool is_held = true);
  void hold_friction_where_unfit();
  void widen_by_mass();
  void begin_from_steady_lag();
  void join_held_out();
  void judge_lack_of_fit();
  Eigen::MatrixXd derivatives(const Indices& indices);
  std::vector<FeatureDoubt> feature_doubts(const Eigen::MatrixXd& j);
  double widening() const;
  void doubt_by_lacking_features();
  std::vector<std::string> what_residual_goes_with();
  void doubt_gains_without_volts();
  bool is_torque_mode() const;
  double closed_loop_rms() const;
  void complete_torque_mode();
  AxisFit finish_torque_mode();
  void begin_screw();
  void retry_screw();
  bool is_screw_fitted() const;
  void judge_screw();
  Eigen::VectorXd lost_motion_by(const Indices& indices) const;
  double lost_motion_deviation(const Indices& indices, const Indices& held);
  void derive_lost_motion();
  void note_screw_that_is_not_seen();
  void estimate_hum();
  void drop_doubtful_hum();
  void align();
  void search(int number, const config::MachineFile& begin);
  void search_further(const config::MachineFile& begin);
  void polish(int iterations, int least_rank = 0, double tolerance = 1e-5);
  void judge_and_hold();
  bool note(const Indices& judged, const Judgement& judgement);
  Indices free_indices() const;
  ParameterSet set_of(const Indices& indices) const;
  Eigen::VectorXd residuals(const ParameterSet& set, const Eigen::VectorXd& units) const;
  void hold(Searched& parameter, Verdict verdict, double sigma, double relative, std::string why);
  void report(double share) const;
  void doubt_hum_without_amplitude();
  double rms_of(const config::MachineFile& machine) const;   // of the positions [mm]
  double cost_of(const config::MachineFile& machine) const;  // RMS of all residuals
  AxisFit finish();

  AxisProblem problem_;
  FitOptions options_;
  config::MachineFile start_;
  config::MachineFile current_;
  std::vector<Searched> searched_;
  FittedParameter count_;               // of the encoder
  std::vector<FittedParameter> gains_;  // of the servo, where the drive commands tell them
  FittedParameter delay_;               // of the output, in torque mode
  std::vector<FittedParameter> loads_;  // weight and asymmetry, where the force tells them
  std::vector<AxisRecord> records_;     // whole, while the problem has their first part
  bool holds_friction_ = false;         // at what the force tells
  AxisFit fit_;
};

}  // namespace twin::studies::identify
