#include "operator/operator_station.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <utility>
#include <vector>

#include "core/atomic_file.hpp"
#include "operator/commands.hpp"

namespace twin::operator_station {
namespace {

constexpr int kShowEvery = 200;  // [ms]

/// Writes on the terminal, which may be gone by now; the run goes on without it.
void show(const std::string& text) {
  std::fputs(text.c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace

Expected<std::unique_ptr<OperatorStation>> OperatorStation::open(const Options& options,
                                                                 runtime::OperatorPanel& panel) {
  std::unique_ptr<ControlSocket> socket;
  if (!options.socket.empty()) {
    TWIN_TRY(socket, ControlSocket::open(options.socket, [&panel](std::string_view line) {
               return answer(line, panel);
             }));
  }
  Descriptor wake(::eventfd(0, EFD_CLOEXEC));
  if (wake.get() < 0) {
    return file_error("the operator's station", "start", errno);
  }
  return std::unique_ptr<OperatorStation>(
      new OperatorStation(options, panel, std::move(socket), std::move(wake)));
}

OperatorStation::OperatorStation(const Options& options, runtime::OperatorPanel& panel,
                                 std::unique_ptr<ControlSocket> socket, Descriptor wake)
    : panel_(panel),
      socket_(std::move(socket)),
      terminal_(options.has_keys ? std::make_unique<RawTerminal>() : nullptr),
      has_keys_(terminal_ != nullptr && terminal_->is_raw()),
      shows_status_(has_keys_ && options.shows_status && isatty(STDERR_FILENO) == 1),
      wake_(std::move(wake)),
      thread_([this](const std::stop_token& stop) { work(stop); }) {}

OperatorStation::~OperatorStation() {
  thread_.request_stop();
  const std::uint64_t one = 1;
  [[maybe_unused]] const ssize_t written = ::write(wake_.get(), &one, sizeof(one));
  thread_.join();
  if (shows_status_) {
    show("\r\033[K");
  }
}

void OperatorStation::work(const std::stop_token& stop) {
  std::vector<pollfd> polled;
  while (!stop.stop_requested()) {
    polled.clear();
    polled.push_back({wake_.get(), POLLIN, 0});
    polled.push_back({has_keys_ ? STDIN_FILENO : -1, POLLIN, 0});
    if (socket_) {
      socket_->add_to(polled);
    }
    if (::poll(polled.data(), polled.size(), shows_status_ ? kShowEvery : -1) < 0) {
      continue;  // a signal
    }
    if ((polled[1].revents & POLLIN) != 0) {
      read_keys();
    } else if (polled[1].revents != 0) {
      has_keys_ = false;  // the terminal is gone
    }
    if (socket_) {
      socket_->serve(polled);
    }
    if (shows_status_) {
      show("\r" + status_line(panel_) + "\033[K");
    }
  }
}

void OperatorStation::read_keys() {
  char keys[16];
  const ssize_t count = ::read(STDIN_FILENO, keys, sizeof(keys));
  for (ssize_t i = 0; i < count; ++i) {
    press(keys[i], panel_);
  }
}

}  // namespace twin::operator_station
