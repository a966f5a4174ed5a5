#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/descriptor.hpp"
#include "core/error.hpp"
#include "core/temporary_name.hpp"

namespace twin::pictures {

/// Text of a file and the file's name.
using NamedText = std::pair<const char*, std::string>;

/// Whether a study draws its pictures.
enum class Drawing { kDrawn, kLeftOut };

/// A folder inside the results' folder where everything is made first. It is gone at the end; if the
/// program is killed, the next workshop in that place removes it.
class Workshop {
 public:
  /// Makes the folder of the results, when missing, and the workshop in it.
  static Expected<Workshop> open(const std::filesystem::path& results);

  Workshop(Workshop&& other) noexcept = default;
  Workshop& operator=(Workshop&&) = delete;
  Workshop(const Workshop&) = delete;
  Workshop& operator=(const Workshop&) = delete;
  ~Workshop();

  const std::filesystem::path& folder() const noexcept { return folder_; }

  /// Folder in the workshop where the pictures of a study are drawn. It is not made here.
  std::filesystem::path pictures() const { return folder_ / "figures"; }

  /// Moves a study's results to the results' folder: its texts, and its pictures where they were
  /// drawn. Where they were not, those of an earlier run are taken away. All texts are written
  /// before the first of these steps.
  Expected<void> deliver_study(std::span<const NamedText> texts, Drawing drawing) const;

  /// Writes texts into the workshop, each under its name.
  /// @returns the names
  Expected<std::vector<std::string>> write(std::span<const NamedText> texts) const;

  /// Moves files and folders made in the workshop to the results, in place of older ones.
  Expected<void> deliver(std::span<const std::string> names) const;

  /// Takes away what an earlier run left under these names and this one does not make.
  void discard_older(std::span<const std::string> names) const;

 private:
  Expected<void> deliver_one(const std::string& name) const;
  Workshop(std::filesystem::path results, std::filesystem::path folder, Descriptor lock)
      : results_(std::move(results)),
        folder_(std::move(folder)),
        listed_(folder_),
        lock_(std::move(lock)) {}

  std::filesystem::path results_;
  std::filesystem::path folder_;
  TemporaryName listed_;
  Descriptor lock_;  // tells other programs that somebody works in the folder
};

}  // namespace twin::pictures
