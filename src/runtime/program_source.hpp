#pragma once

#include <concepts>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "gcode/reader.hpp"

namespace twin::runtime {

/// An NC program: a file, or a text in memory.
struct ProgramSource {
  ProgramSource() = default;
  /// A program in a file.
  template <std::convertible_to<std::filesystem::path> Path>
  ProgramSource(const Path& path) : file(path) {}  // NOLINT: a path names a program
  /// A program held in memory. @param name stands for the file in messages
  static ProgramSource from_text(std::string text, const std::filesystem::path& name) {
    ProgramSource source(name);
    source.text = std::move(text);
    return source;
  }

  std::filesystem::path file;       ///< the program, or the name of the text
  std::optional<std::string> text;  ///< the program itself, where it is not in a file
};

/// Begins to read a program.
Expected<gcode::Reader> open_program(const ProgramSource& program,
                                     const gcode::ReaderOptions& options);

}  // namespace twin::runtime
