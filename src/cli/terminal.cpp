#include "cli/terminal.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "core/atomic_file.hpp"

namespace twin::cli {
namespace {

constexpr int kBarWidth = 30;              // [characters]
constexpr std::size_t kMessageIndent = 6;  // of the lines after the first: under "twin: "

/// Writes on stderr. That it cannot be written is nothing that could be told.
void put_error(const std::string& text) {
  std::fputs(text.c_str(), stderr);
  std::fflush(stderr);
}

/// A text whose control characters are shown, so that it is one line and no terminal obeys it.
std::string visible(std::string_view text) {
  std::string shown;
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    shown += code < 32 || code == 127 ? fmt::format("\\x{:02X}", code) : std::string(1, c);
  }
  return shown;
}

/// @param label  what stands before the text, in a style
void print_message(std::string_view label, Style style, std::string_view text) {
  const std::string line = fmt::format("{} {}", label, visible(text));
  const std::size_t columns = columns_of(STDERR_FILENO);
  const std::string shown =
      columns > 2 * kMessageIndent ? wrapped(line, kMessageIndent, 0, columns) : line;
  put_error(styled(STDERR_FILENO, style, label) + shown.substr(label.size()) + "\n");
}

bool shows_colours(int stream) {
  const char* const refusal = std::getenv("NO_COLOR");
  const char* const terminal = std::getenv("TERM");
  return isatty(stream) == 1 && (refusal == nullptr || *refusal == '\0') && terminal != nullptr &&
         std::string_view(terminal) != "dumb";
}

int output_failure = 0;  // errno of the first failure of stdout, or 0

void note_output(bool is_written) {
  if (!is_written && output_failure == 0) {
    output_failure = errno != 0 ? errno : EIO;
  }
}

}  // namespace

std::string styled(int stream, Style style, std::string_view text) {
  if (!shows_colours(stream)) {
    return std::string(text);
  }
  const int code = style == Style::kBold ? 1 : style == Style::kError ? 31 : 33;
  return fmt::format("\033[{}m{}\033[0m", code, text);
}

std::string with_bold_headings(std::string_view text) {
  std::string shown;
  for (bool is_first = true; !text.empty(); is_first = false) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    const bool is_heading = is_first || (line.ends_with(':') && line.front() != ' ');
    shown +=
        is_heading && !line.empty() ? styled(STDOUT_FILENO, Style::kBold, line) : std::string(line);
    shown += text.substr(end, 1);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return shown;
}

std::size_t columns_of(int stream) {
  if (isatty(stream) != 1) {
    return 0;
  }
  struct winsize size {};
  return ioctl(stream, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

std::string wrapped(std::string_view text, std::size_t indent, std::size_t first,
                    std::size_t width) {
  std::string lines;
  std::size_t column = first;
  bool is_new_line = true;
  const auto break_line = [&] {
    lines += '\n';
    column = indent;
    is_new_line = true;
  };
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of(" \n"), text.size());
    const std::string_view word = text.substr(0, end);
    if (!is_new_line && column + 1 + word.size() > width) {
      break_line();
    }
    if (is_new_line && !lines.empty()) {
      lines.append(indent, ' ');
    } else if (!is_new_line) {
      lines += ' ';
      ++column;
    }
    lines += word;
    column += word.size();
    is_new_line = false;
    if (end < text.size() && text[end] == '\n') {
      break_line();
    }
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

void put_out(std::string_view text) {
  errno = 0;
  note_output(std::fwrite(text.data(), 1, text.size(), stdout) == text.size());
}

Expected<void> finish_output() {
  errno = 0;
  note_output(std::fflush(stdout) == 0);
  return output_failure == 0 ? Expected<void>()
                             : file_error("standard output", "write", output_failure);
}

void print_error(std::string_view text) { print_message("twin:", Style::kError, text); }

void print_error(const Error& error) { print_error(to_string(error)); }

void print_note(std::string_view text) { print_message("twin: note:", Style::kNote, text); }

Progress::Progress(std::string what, Verbosity verbosity)
    : what_(std::move(what)),
      is_shown_(verbosity == Verbosity::kNormal && isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (is_shown_) {
    put_error("\r\033[K");
  }
}

void Progress::show(double share) {
  if (!is_shown_) {
    return;
  }
  const double part = std::clamp(share, 0.0, 1.0);
  const int done = static_cast<int>(part * kBarWidth);
  put_error(fmt::format("\r{} [{:=<{}}{:<{}}] {:3.0f} %\033[K", what_, "", done, "",
                        kBarWidth - done, part * 100.0));
}

void Progress::rename(std::string what) {
  what_ = std::move(what);
  show(0.0);
}

std::function<void(double)> Progress::callback() {
  return [this](double share) { show(share); };
}

}  // namespace twin::cli
