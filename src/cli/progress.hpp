#pragma once

#include <functional>
#include <string>

namespace twin::cli {

/// A progress bar on the terminal's stderr; nothing where stderr is no terminal.
class Progress {
 public:
  Progress(std::string what, bool quiet);
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
