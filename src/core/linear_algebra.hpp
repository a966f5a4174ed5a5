#pragma once

#include <Eigen/Core>

namespace twin {

// Of matrices of any size. They are here because every use of Eigen's own takes seconds to compile.

/// The product a^T b.
Eigen::MatrixXd transposed_product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

/// The solution x of a x = b by an LDL^T decomposition with pivots.
///
/// @param a  symmetric, and positive or negative semidefinite
Eigen::MatrixXd solve_symmetric(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

}  // namespace twin
