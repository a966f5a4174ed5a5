#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace twin::test {

/// How a child process ended.
struct ChildResult {
  int status = -1;           ///< exit status; 128 + the signal that ended it
  std::string out;           ///< what it wrote on stdout
  std::string err;           ///< what it wrote on stderr
  double peak_memory = 0.0;  ///< largest resident set [MB]
};

/// A running `twin`, its output going to files of its own.
class Child {
 public:
  struct Options {
    std::filesystem::path directory;   ///< it runs there, and `child.out`, `child.err` too
    std::optional<long> largest_file;  ///< bytes a file may grow to, as on a full disk
    std::function<void()> prepare{};   ///< called in the child before it becomes `twin`
  };

  Child(const std::vector<std::string>& arguments, Options options);
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child();

  void signal(int number) const;
  pid_t pid() const { return pid_; }
  ChildResult wait();

 private:
  Options options_;
  pid_t pid_ = -1;
};

/// Runs `twin` with some arguments to its end.
ChildResult run_twin(const std::vector<std::string>& arguments, const Child::Options& options);

}  // namespace twin::test
