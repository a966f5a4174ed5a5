#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "core/error.hpp"

/// What the program writes on the terminal beside its results.
namespace twin::cli {

/// Whether a command says more than its errors.
enum class Verbosity {
  kNormal,
  kQuiet,  ///< --quiet
};

/// Breaks a text at its blanks so that no line is longer than `width`; a word that is longer has a
/// line of its own. Line breaks of the text stay.
///
/// @param indent  blanks in front of every line but the first
/// @param first   columns that are taken already in the first line
std::string wrapped(std::string_view text, std::size_t indent, std::size_t first,
                    std::size_t width);

/// Prints "twin: ERROR" on stderr: one line, which is broken at blanks on a terminal only.
void print_error(std::string_view text);
void print_error(const Error& error);

/// Prints "twin: note: TEXT" on stderr in the same way.
void print_note(std::string_view text);

/// A progress bar on the terminal's stderr; nothing where stderr is no terminal.
class Progress {
 public:
  /// @param what  what stands before the bar
  Progress(std::string what, Verbosity verbosity);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

  /// @param share  what is done, 0 to 1
  void show(double share);
  /// Changes what stands before the bar, and shows that nothing is done yet.
  void rename(std::string what);
  /// show() as a function object.
  std::function<void(double)> callback();

 private:
  std::string what_;
  bool is_shown_;
};

}  // namespace twin::cli
