#pragma once

#include <fmt/format.h>

#include <functional>
#include <string>
#include <string_view>
#include <utility>

#include "core/error.hpp"

/// What the program writes on the terminal beside its results.
namespace twin::cli {

/// Whether a command says more than its errors.
enum class Verbosity {
  kNormal,
  kQuiet,  ///< --quiet
};

/// How words stand out on a terminal.
enum class Style { kBold, kError, kNote };

/// A text in a style where the stream is a terminal that shows colours; elsewhere, and where the
/// environment has NO_COLOR (no-color.org) or TERM=dumb, the text itself.
std::string styled(int stream, Style style, std::string_view text);

/// A table or a help with its headings in bold on stdout's terminal: the first line, and lines that
/// begin at the margin and end with a colon.
std::string with_bold_headings(std::string_view text);

/// Columns of the terminal at a stream, as STDERR_FILENO; 0 where there is none.
std::size_t columns_of(int stream);

/// Breaks a text at its blanks so that no line is longer than `width`; a word that is longer has a
/// line of its own. Line breaks of the text stay.
///
/// @param indent  blanks in front of every line but the first
/// @param first   columns that are taken already in the first line
std::string wrapped(std::string_view text, std::size_t indent, std::size_t first,
                    std::size_t width);

/// Prints text on stdout. A failure is kept for finish_output(); it does not end the command, whose
/// results are files.
void put_out(std::string_view text);

/// The same with a format.
template <class... Values>
void print_out(fmt::format_string<Values...> text, Values&&... values) {
  put_out(fmt::format(text, std::forward<Values>(values)...));
}

/// Hands what was printed to the system, so that it is seen at once.
/// @returns why something could not be printed, now or before
Expected<void> finish_output();

/// Prints "twin: ERROR" on stderr: one line, which is broken at blanks on a terminal only. Control
/// characters, as a file's name may have them, are shown as \x0A.
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
