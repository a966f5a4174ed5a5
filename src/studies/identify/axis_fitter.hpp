#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "studies/identify/axis_fit.hpp"
#include "studies/identify/judge.hpp"
#include "studies/identify/parameter.hpp"

namespace twin::studies::identify {

/// The fit of one axis on its way.
class AxisFitter {
 public:
  AxisFitter(AxisProblem&& problem, FitOptions options);
  AxisFit run();

 private:
  bool has_volts() const { return problem_.records().front().has_volts(); }
  bool is_fixed(const std::string& key) const {
    return std::ranges::find(options_.fixed, key) != options_.fixed.end();
  }
  bool is_freed(const std::string& key) const {
    return std::ranges::find(options_.freed, key) != options_.freed.end();
  }
  void estimate_directly();
  void estimate_quantum();
  void estimate_gains();
  void estimate_hum();
  void align();
  void search(int number, const config::MachineFile& begin);
  void search_further(const config::MachineFile& begin);
  void polish(int iterations, int least_rank = 0);
  void judge_and_hold();
  bool take(const std::vector<std::size_t>& places, const Judgement& judgement);
  std::vector<std::size_t> free_places() const;
  ParameterSet set_of(const std::vector<std::size_t>& places) const;
  Eigen::VectorXd residuals(const ParameterSet& set, const Eigen::VectorXd& units) const;
  void hold(std::size_t place, Verdict verdict, double sigma, double relative, std::string why);
  void report(double share) const;
  FittedParameter& result(const std::string& key, const std::string& name);
  void doubt_hum_without_amplitude();
  double rms_of(const config::MachineFile& machine);

  AxisProblem problem_;
  FitOptions options_;
  config::MachineFile start_;
  config::MachineFile current_;
  std::vector<Candidate> candidates_;
  std::vector<FittedParameter> results_;  // one for each candidate, then what is measured directly
  std::vector<bool> is_held_;
  AxisFit fit_;
};

}  // namespace twin::studies::identify
