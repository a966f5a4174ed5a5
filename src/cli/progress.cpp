#include "cli/progress.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace twin::cli {
namespace {

constexpr int kWidth = 30;  // of the bar [characters]

}  // namespace

Progress::Progress(std::string what, bool quiet)
    : what_(std::move(what)), is_shown_(!quiet && isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (is_shown_) {
    fmt::print(stderr, "\r\033[K");
    std::fflush(stderr);
  }
}

void Progress::show(double share) {
  if (!is_shown_) {
    return;
  }
  const double part = std::clamp(share, 0.0, 1.0);
  const int done = static_cast<int>(part * kWidth);
  fmt::print(stderr, "\r{} [{:=<{}}{:<{}}] {:3.0f} %", what_, "", done, "", kWidth - done,
             part * 100.0);
  std::fflush(stderr);
}

void Progress::rename(std::string what) {
  what_ = std::move(what);
  show(0.0);
}

std::function<void(double)> Progress::callback() {
  return [this](double share) { show(share); };
}

}  // namespace twin::cli
