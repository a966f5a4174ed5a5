#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "twin/export.hpp"

namespace twin {

/// The figures of a run: what summary.json holds, by name.
///
/// A key is the path to a value, with dots: "planned_time_s", "contour_error_um.max",
/// "audit.axis.x.jerk_mm_per_s3". Each key names its unit. A value that does not change and is
/// cheap to copy. Thread-safe.
class TWIN_EXPORT Summary {
 public:
  /// A number. @throws Failure, with the nearest key, if there is none of this name
  double number(std::string_view key) const;
  /// A text, such as "hal". @throws Failure as number() does
  std::string text(std::string_view key) const;
  bool has(std::string_view key) const noexcept;
  /// All keys of numbers and texts, in the order of the file.
  std::vector<std::string> keys() const;

  const std::string& json() const noexcept;   ///< the text of summary.json
  const std::string& table() const noexcept;  ///< what `twin run` prints

 private:
  friend struct Inside;
  struct Data;
  explicit Summary(std::shared_ptr<const Data> data);

  std::shared_ptr<const Data> data_;
};

}  // namespace twin
