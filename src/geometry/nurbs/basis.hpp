#pragma once

#include <array>

/// B-spline basis functions by the recursion of Cox and de Boor.
namespace twin::geometry {

/// The results of one pass of the recursion at u in span s = [u_s, u_{s+1}): the basis functions of
/// the three highest degrees that are not zero there, and the reciprocals of the knot differences,
/// which the derivatives need too.
template <int P>
struct Basis {
  std::array<double, P + 1> n;  ///< N_{s-P+j, P}(u), j = 0..P
  std::array<double, P> n1;     ///< N_{s-P+1+j, P-1}(u), j = 0..P-1
  std::array<double, P> n2;     ///< N_{s-P+2+j, P-2}(u), j = 0..P-2; unused when P = 1
  std::array<double, P> inv1;   ///< 1 / (u_{s+1+j} - u_{s-P+1+j}), j = 0..P-1
  std::array<double, P> inv2;   ///< 1 / (u_{s+1+j} - u_{s-P+2+j}), j = 0..P-2
};

/// Evaluates the triangular scheme [WY09, Eqs. 9, 10, Fig. 7]
///   N_{i,0} = 1 on span s,
///   N_{i,d}(u) = (u - u_i) / (u_{i+d} - u_i) N_{i,d-1}(u)
///              + (u_{i+d+1} - u) / (u_{i+d+1} - u_{i+1}) N_{i+1,d-1}(u),
/// column by column, d = 1..P, without the functions that are zero on the span. No denominator is
/// smaller than the width of the span, so there is no division by zero in a span that is not empty.
///
/// @param knot  address of u_s; knot[-P+1] .. knot[P] are read
/// @note Real-time safe.
template <int P>
[[gnu::always_inline]] inline Basis<P> evaluate_basis(const double* knot, double u) noexcept {
  Basis<P> basis{};
  std::array<double, P + 1>& n = basis.n;
  n[0] = 1.0;
  for (int d = 1; d <= P; ++d) {
    double carried = 0.0;
    for (int r = 0; r < d; ++r) {
      const double right = knot[r + 1];
      const double left = knot[r + 1 - d];
      const double inverse = 1.0 / (right - left);
      if (d == P) {
        basis.n1[r] = n[r];
        basis.inv1[r] = inverse;
      } else if (d == P - 1) {
        basis.n2[r] = n[r];
        basis.inv2[r] = inverse;
      }
      const double share = n[r] * inverse;
      n[r] = carried + (right - u) * share;
      carried = (u - left) * share;
    }
    n[d] = carried;
  }
  return basis;
}

}  // namespace twin::geometry
