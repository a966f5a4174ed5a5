#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"

/// Numbers as a page holds them: whole multiples of a step, as differences, deflated, as text.
namespace twin::pictures {

/// How a column was packed.
struct PackedColumn {
  std::string name;
  double step = 1.0;      ///< unit of its whole numbers, in the unit of the name
  int order = 0;          ///< how often the page must sum up to have them
  unsigned planes = 0;    ///< bytes of its largest difference
  std::size_t count = 0;  ///< of its numbers
};

/// Collects columns and texts and packs them as one.
///
/// A column of count numbers x becomes the whole numbers q = round(x / step), of which differences
/// of order 0 to 3 are taken, whichever are smallest. A difference d is stored as the unsigned
/// number 2 |d| - (d < 0), low bytes of all the numbers first, then the next bytes: planes of count
/// bytes, as many as the largest one needs.
class Packer {
 public:
  /// Appends a column. A number that is not finite or too large for 32 bits is taken as the nearest
  /// that is not; not a number is taken as 0.
  PackedColumn add(std::string name, const std::vector<double>& values, double step);
  /// Appends bytes as they are.
  void add_bytes(std::string_view bytes) { bytes_.append(bytes); }

  /// What was appended, in zlib's format [RFC 1950] as base64 [RFC 4648].
  Expected<std::string> finish() const;

 private:
  std::string bytes_;
};

/// Text in base64 [RFC 4648], with padding.
std::string base64(std::string_view bytes);

}  // namespace twin::pictures
