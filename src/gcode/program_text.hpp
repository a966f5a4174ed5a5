#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace twin::gcode {

/// An NC program as it was when it was read: a private copy of its bytes that nobody can change.
///
///   file, FIFO, standard input --read()--> ProgramText --> any number of readings, each its own
///
/// Whatever looks at a program (check, estimate, plan, recorder, pictures) reads the same
/// ProgramText, so what is checked is what runs. Copies share the bytes. Small programs are held in
/// memory, larger ones in a file without a name, so memory does not grow with the program.
class ProgramText {
 public:
  static constexpr std::size_t kInMemory = std::size_t{1} << 20;  ///< longer ones: on disk [bytes]

  /// How read() goes about it.
  struct Reading {
    std::filesystem::path folder;  ///< where the copy of a long program is; empty: temporary files
    const std::atomic<bool>* stop = nullptr;  ///< ends a reading with kInterrupted; may be null
    /// Where files of subprograms are looked for, behind the folder of the program itself.
    std::vector<std::filesystem::path> subprogram_folders{};
  };

  /// Reads a program once, to its end. The path "-" is standard input.
  ///
  /// @returns an error with the file's name where it is missing, unreadable, a directory, changes
  /// while it is read, or does not end (4 GiB of a pipe); or where the copy cannot be written
  static Expected<ProgramText> read(const std::filesystem::path& path, const Reading& reading);
  static Expected<ProgramText> read(const std::filesystem::path& path) { return read(path, {}); }

  /// An empty program without a name.
  ProgramText();

  /// A program held in memory. @param name  stands for the file in messages
  static ProgramText from_text(std::string text, std::filesystem::path name);

  static constexpr std::size_t kMostSubprograms = 100;  ///< files of one program

  /// The file of a subprogram, NAME.ngc or NAME.nc in one of the folders; nothing where there is
  /// none. It is read once, at the first call, and then belongs to the program: copies of this
  /// object give the same bytes. Thread-safe.
  ///
  /// @param name  letters, digits, - and _; other names have no file
  /// @returns an error if the file cannot be read, or lies outside the folder through a link
  Expected<std::optional<ProgramText>> subprogram(const std::string& name) const;

  /// The subprograms' files that were read so far, in the order of their names.
  std::vector<ProgramText> subprograms() const;

  const std::filesystem::path& file() const noexcept;  ///< as it was named to read()
  std::int64_t size() const noexcept;                  ///< [bytes]
  const std::string& sha256() const noexcept;          ///< of the bytes, 64 hexadecimal digits

  /// Copies bytes from a place on. @returns how many; fewer than asked for at the end only
  Expected<std::size_t> copy(std::int64_t offset, std::span<char> to) const;

  /// Whether the file of the program, or of a subprogram, is another one by now: changed, replaced,
  /// or gone.
  bool has_changed() const;

 private:
  struct Data;
  explicit ProgramText(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

  std::shared_ptr<const Data> data_;
};

}  // namespace twin::gcode
