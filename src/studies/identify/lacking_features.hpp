#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "config/machine_file.hpp"
#include "hal/machine.hpp"

namespace twin::studies::identify {

/// A feature that machines have and that no search fits.
struct LackingFeature {
  std::string name;
  double usual = 1.0;  ///< strength that machines have it in, where a fit does not show it
  /// The machine with some of the feature; two machines where it has a phase, too.
  std::vector<config::MachineFile> machines;
};

/// The features that a fitted machine may lack, each in a strength that is small beside what it is
/// added to: parts of a millisecond, or a tenth of the friction.
std::vector<LackingFeature> lacking_features(const config::MachineFile& fitted, hal::Axis axis,
                                             bool has_volts);

/// What one feature would change of a least-squares fit.
struct FeatureDoubt {
  std::string name;        ///< of the feature
  Eigen::VectorXd spread;  ///< root mean square change of each parameter, in the unit of J
  double share = 0.0;      ///< of the residual's variance, that the feature explains
};

/// How far the parameters of a fit would move if the model had a feature.
///
/// With derivatives J of the residual r and the signature D, the change of the residual by the
/// feature in unit strength, the best strength beside the parameters is to first order
///   a = -(Dp^T Dp)^-1 Dp^T r,   Dp = D - J (J^T J)^-1 J^T D,
/// and with it the parameters move by -S a, S = (J^T J)^-1 J^T D: the bias of a variable that was
/// left out. The mean square of the move is that of a's estimate and of its deviation, whose scores
/// are summed over blocks, as in block_covariance(). Where J can do nearly all that the feature does,
/// as where an output delay does what a late encoder does, a is not known from r, and taken to be 0
/// with a usual strength as its deviation.
FeatureDoubt feature_doubt(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& residual,
                           const Eigen::MatrixXd& signature, double usual, Eigen::Index block);

}  // namespace twin::studies::identify
