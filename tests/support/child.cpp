#include "child.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <utility>

#include "files.hpp"

namespace twin::test {
namespace {

constexpr int kCannotStart = 126;

void send_to(const char* file, int descriptor) {
  const int opened = open(file, O_WRONLY | O_CREAT | O_TRUNC, 0666);
  dup2(opened, descriptor);
  close(opened);
}

/// In the child: only calls that are safe between fork and exec.
[[noreturn]] void become_twin(char* const* arguments, const Child::Options& options) {
  if (chdir(options.directory.c_str()) != 0) {
    _exit(kCannotStart);
  }
  send_to("/dev/null", STDIN_FILENO);
  send_to("child.out", STDOUT_FILENO);
  send_to("child.err", STDERR_FILENO);
  if (options.largest_file) {
    const auto bytes = static_cast<rlim_t>(*options.largest_file);
    const rlimit limit{bytes, bytes};
    setrlimit(RLIMIT_FSIZE, &limit);
    std::signal(SIGXFSZ, SIG_IGN);  // write() then fails with EFBIG
  }
  if (options.prepare) {
    options.prepare();
  }
  execv(TWIN_EXECUTABLE, arguments);
  _exit(kCannotStart);
}

}  // namespace

Child::Child(const std::vector<std::string>& arguments, Options options)
    : options_(std::move(options)) {
  std::vector<std::string> texts{"twin"};
  texts.insert(texts.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& text : texts) {
    pointers.push_back(text.data());
  }
  pointers.push_back(nullptr);
  pid_ = fork();
  if (pid_ == 0) {
    become_twin(pointers.data(), options_);
  }
  EXPECT_GT(pid_, 0);
}

Child::~Child() {
  if (pid_ > 0) {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
}

void Child::signal(int number) const { kill(pid_, number); }

ChildResult Child::wait() {
  int status = 0;
  rusage usage{};
  EXPECT_EQ(wait4(pid_, &status, 0, &usage), pid_);
  pid_ = -1;
  ChildResult result;
  result.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  result.out = content(options_.directory / "child.out");
  result.err = content(options_.directory / "child.err");
  result.peak_memory = static_cast<double>(usage.ru_maxrss) / 1024.0;
  return result;
}

ChildResult run_twin(const std::vector<std::string>& arguments, const Child::Options& options) {
  return Child(arguments, options).wait();
}

}  // namespace twin::test
