#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/error.hpp"

namespace twin {

/// What to do with the temporary file of an AtomicFile that is never committed.
enum class OnAbandon {
  kRemove,  ///< nothing is left behind
  kKeep,    ///< what was written stays under the temporary name
};

/// An error about a file: "cannot ACTION: TEXT OF ERRNO", with the file's name.
///
/// @param action       what failed, as in "write"
/// @param errno_value  the errno it left
tl::unexpected<Error> file_error(const std::filesystem::path& file, std::string_view action,
                                 int errno_value);

/// A file that appears under its own name only when it is whole.
///
/// Bytes go to a temporary name in the same directory; commit() renames it, which replaces an older
/// file in one step. The temporary is locked while it is written, so that two processes cannot mix
/// their bytes. After a failed write the object stays failed: every further call returns the first
/// error.
class AtomicFile {
 public:
  /// Opens the temporary file and empties it.
  ///
  /// @param target      name of the whole file
  /// @param temporary   name until then, in the same directory as target
  static Expected<AtomicFile> create(std::filesystem::path target, std::filesystem::path temporary,
                                     OnAbandon on_abandon = OnAbandon::kRemove);

  AtomicFile(AtomicFile&& other) noexcept;
  AtomicFile& operator=(AtomicFile&& other) noexcept;
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile();  ///< abandons what was not committed

  /// Appends bytes; they reach the disk in pieces of about 64 kB.
  Expected<void> write(std::string_view bytes);

  /// Writes what is buffered, closes, and renames to the target's name.
  Expected<void> commit();

  /// Closes without renaming; keeps or removes the temporary as told at creation. Harmless when
  /// already closed.
  void abandon() noexcept;

  const std::filesystem::path& target() const noexcept { return target_; }
  const std::filesystem::path& temporary() const noexcept { return temporary_; }

 private:
  AtomicFile() = default;
  Expected<void> flush();

  std::filesystem::path target_;
  std::filesystem::path temporary_;
  OnAbandon on_abandon_ = OnAbandon::kRemove;
  int descriptor_ = -1;
  int failure_ = 0;  ///< errno of the first failed write, or 0
  std::string buffer_;
};

/// Writes a whole small file through "NAME.tmp", or nothing.
Expected<void> write_whole_file(const std::filesystem::path& file, std::string_view content);

}  // namespace twin
