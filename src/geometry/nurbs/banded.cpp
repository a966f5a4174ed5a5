#include "geometry/nurbs/banded.hpp"

#include <cstddef>

namespace twin::geometry {

void solve_pentadiagonal(std::span<BandRow> rows, std::span<Vec3> x) noexcept {
  const std::size_t n = rows.size();
  for (std::size_t r = 0; r < n; ++r) {
    BandRow& row = rows[r];
    if (r >= 2) {
      const BandRow& above = rows[r - 2];
      const double factor =
          row[0] * above[2];  // [2] of a finished row is the reciprocal of its pivot
      row[1] -= factor * above[3];
      row[2] -= factor * above[4];
      x[r] -= factor * x[r - 2];
    }
    if (r >= 1) {
      const BandRow& above = rows[r - 1];
      const double factor = row[1] * above[2];
      row[2] -= factor * above[3];
      row[3] -= factor * above[4];
      x[r] -= factor * x[r - 1];
    }
    row[2] = 1.0 / row[2];
  }
  for (std::size_t r = n; r-- > 0;) {
    if (r + 1 < n) {
      x[r] -= rows[r][3] * x[r + 1];
    }
    if (r + 2 < n) {
      x[r] -= rows[r][4] * x[r + 2];
    }
    x[r] *= rows[r][2];
  }
}

}  // namespace twin::geometry
