#pragma once

#include <filesystem>
#include <list>
#include <optional>

namespace twin {

/// A name that is in a list of what to remove if the process is ended before its work is done.
///
/// It neither makes nor removes what has the name: whoever works under the name does.
class TemporaryName {
 public:
  explicit TemporaryName(std::filesystem::path name);
  TemporaryName(TemporaryName&& other) noexcept;
  TemporaryName& operator=(TemporaryName&& other) noexcept;
  TemporaryName(const TemporaryName&) = delete;
  TemporaryName& operator=(const TemporaryName&) = delete;
  ~TemporaryName();

  /// Removes every file and folder of the list, those of other threads too. For the end of the
  /// process alone.
  static void remove_all() noexcept;

 private:
  std::optional<std::list<std::filesystem::path>::iterator> place_;
};

}  // namespace twin
