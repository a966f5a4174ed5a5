#pragma once

#include <termios.h>

namespace twin::operator_station {

/// While it lives, keys of the terminal on stdin arrive at once and are not shown; Ctrl-C stays
/// what it is, Ctrl-Z does nothing. The terminal is put back at the end and before any signal that
/// ends the process.
///
/// One at a time.
class RawTerminal {
 public:
  RawTerminal();
  RawTerminal(const RawTerminal&) = delete;
  RawTerminal& operator=(const RawTerminal&) = delete;
  ~RawTerminal();

  /// Whether stdin is a terminal that this process may read.
  bool is_raw() const noexcept { return is_raw_; }

  /// Puts the terminal back; may be called by a signal handler.
  static void restore() noexcept;

 private:
  bool is_raw_ = false;
};

}  // namespace twin::operator_station
