#pragma once

#include <filesystem>

#include "core/error.hpp"
#include "reproduce/reproduction.hpp"

namespace twin::reproduce {

/// A folder inside the results' folder where everything is made first; gone at the end, whatever
/// happens.
class Workshop {
 public:
  /// Makes the folder of the results, when missing, and the workshop in it.
  static Expected<Workshop> open(const std::filesystem::path& results);

  Workshop(Workshop&& other) noexcept
      : results_(other.results_), folder_(std::move(other.folder_)) {
    other.folder_.clear();
  }
  Workshop& operator=(Workshop&&) = delete;
  Workshop(const Workshop&) = delete;
  Workshop& operator=(const Workshop&) = delete;
  ~Workshop();

  const std::filesystem::path& folder() const noexcept { return folder_; }

  /// Moves a file or folder made in the workshop to the results, in place of an older one.
  Expected<void> deliver(const std::string& name) const;

 private:
  Workshop(std::filesystem::path results, std::filesystem::path folder)
      : results_(std::move(results)), folder_(std::move(folder)) {}

  std::filesystem::path results_;
  std::filesystem::path folder_;
};

/// Writes tables, page and pictures; the results' folder gets all of them or none.
///
/// @param draws  false leaves the pictures out
Expected<void> write_results(const Reproduction& reproduction, const Workshop& workshop,
                             bool draws);

}  // namespace twin::reproduce
