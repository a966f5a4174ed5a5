#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "core/descriptor.hpp"
#include "core/error.hpp"
#include "core/temporary_name.hpp"

namespace twin {

/// What to do with the temporary file of an AtomicFile that is never committed.
enum class OnAbandon {
  kRemove,  ///< nothing is left behind
  kKeep,    ///< what was written stays under the temporary name
};

/// Whether a file that is committed survives a loss of power.
enum class Durability {
  kSynced,  ///< commit() waits until file and name are on the disk: two waits of some milliseconds
  kCached,  ///< the system writes it when it likes; for what can be made again from other files
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
/// their bytes: the lock is on the file that has the temporary name, not on one that had it before
/// another process renamed it. After a failed write the object stays failed: every further call
/// returns the first error.
///
/// Nothing of another's is written to. A temporary name that is a symbolic link, a FIFO, a socket or
/// a folder is refused; a link to a device is followed.
class AtomicFile {
 public:
  /// Opens the temporary file and empties it.
  ///
  /// @param target      name of the whole file
  /// @param temporary   name until then, in the same directory as target
  static Expected<AtomicFile> create(std::filesystem::path target, std::filesystem::path temporary,
                                     OnAbandon on_abandon = OnAbandon::kRemove,
                                     Durability durability = Durability::kSynced);

  AtomicFile(AtomicFile&& other) noexcept = default;
  AtomicFile& operator=(AtomicFile&& other) noexcept;
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile();  ///< abandons what was not committed

  /// Appends bytes; they reach the disk in pieces of about 64 kB.
  Expected<void> write(std::string_view bytes);

  /// Writes what is buffered, waits for the disk if it is to be synced, renames to the target's name
  /// and closes.
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
  std::optional<TemporaryName> listed_;  ///< unless the temporary is to be kept
  OnAbandon on_abandon_ = OnAbandon::kRemove;
  Durability durability_ = Durability::kSynced;
  Descriptor descriptor_;
  int failure_ = 0;  ///< errno of the first failed write, or 0
  std::string buffer_;
};

/// The temporary name of a file: "NAME.tmp".
std::filesystem::path temporary_of(std::filesystem::path file);

/// Writes a whole small file through "NAME.tmp", or nothing.
Expected<void> write_whole_file(const std::filesystem::path& file, std::string_view content,
                                Durability durability = Durability::kSynced);

/// The bytes of a whole file.
Expected<std::string> read_whole_file(const std::filesystem::path& file);

/// Waits until the names in a folder are on the disk; where that cannot be had, does nothing.
void sync_folder(const std::filesystem::path& folder) noexcept;

}  // namespace twin
