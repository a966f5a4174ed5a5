#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"

namespace twin::pictures {

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

  /// Writes texts into the workshop, each under its name, and appends the names.
  Expected<void> write(std::span<const std::pair<const char*, std::string>> texts,
                       std::vector<std::string>& names) const;

  /// Moves files and folders made in the workshop to the results, in place of older ones.
  Expected<void> deliver(std::span<const std::string> names) const;

  /// Takes away what an earlier run left under these names and this one does not make.
  void discard_older(std::span<const std::string> names) const;

 private:
  Expected<void> deliver_one(const std::string& name) const;
  Workshop(std::filesystem::path results, std::filesystem::path folder)
      : results_(std::move(results)), folder_(std::move(folder)) {}

  std::filesystem::path results_;
  std::filesystem::path folder_;
};

}  // namespace twin::pictures
