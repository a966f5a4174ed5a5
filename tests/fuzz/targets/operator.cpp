#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <memory>
#include <vector>

#include "core/json.hpp"
#include "operator/commands.hpp"
#include "operator/control_socket.hpp"
#include "runtime/override_schedule.hpp"
#include "studies/identify/recording_columns.hpp"
#include "tests/fuzz/target.hpp"
#include "tests/fuzz/temporary_folder.hpp"

namespace twin::fuzz {
namespace operator_target {

/// A control socket that stands as long as the process, with its panel.
class Station {
 public:
  Station() {
    auto opened = operator_station::ControlSocket::open(
        folder_.path() / "control",
        [this](std::string_view line) { return operator_station::answer(line, panel_); });
    promise(opened.has_value(), "no control socket");
    socket_ = std::move(*opened);
  }
  Station(const Station&) = delete;
  Station& operator=(const Station&) = delete;
  ~Station() { socket_.reset(); }

  runtime::OperatorPanel& panel() { return panel_; }

  /// Sends bytes as one client, and checks that every line of the answer is JSON.
  void send(Bytes bytes) {
    const int client = ::socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    (folder_.path() / "control").string().copy(address.sun_path, sizeof address.sun_path - 1);
    promise(::connect(client, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0,
            "the control socket takes no client");
    serve();
    std::string heard;
    while (!bytes.empty()) {
      const ssize_t sent = ::send(client, bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (sent <= 0) {
        break;
      }
      bytes = bytes.subspan(static_cast<std::size_t>(sent));
      serve();
      hear(client, heard);
    }
    hear(client, heard);
    ::close(client);
    serve();
    check(heard);
  }

 private:
  void serve() {
    for (int i = 0; i < 3; ++i) {
      std::vector<pollfd> polled;
      socket_->add_to(polled);
      if (::poll(polled.data(), polled.size(), 0) <= 0) {
        return;
      }
      socket_->serve(polled);
    }
  }
  static void hear(int client, std::string& heard) {
    char part[4096];
    for (ssize_t got; (got = ::recv(client, part, sizeof part, 0)) > 0;) {
      heard.append(part, static_cast<std::size_t>(got));
    }
  }
  static void check(std::string_view heard) {
    for (std::size_t end; (end = heard.find('\n')) != std::string_view::npos;) {
      promise(!parse_json(heard.substr(0, end)).is_discarded(), "an answer that is no JSON");
      heard.remove_prefix(end + 1);
    }
  }

  TemporaryFolder folder_;
  runtime::OperatorPanel panel_;
  std::unique_ptr<operator_station::ControlSocket> socket_;
};

void read_as_schedule(std::string_view text) {
  const auto schedule = runtime::parse_override_schedule(text);
  double last = -1.0;
  for (const runtime::OverrideChange& change :
       schedule.value_or(std::vector<runtime::OverrideChange>{})) {
    promise(std::isfinite(change.time) && change.time >= last, "times of a schedule not in order");
    promise(change.percent >= 0.0 && change.percent <= runtime::kHighestOverride,
            "an override out of its range");
    last = change.time;
  }
}

void run(Bytes bytes) {
  static Station station;
  station.panel().set_override(100.0);
  station.panel().hold(false);
  station.send(bytes);
  const std::string_view text = text_of(bytes);
  for (const char key : text.substr(0, 64)) {
    operator_station::press(key, station.panel());
  }
  promise(!operator_station::status_line(station.panel()).empty(), "no status line");
  const double percent = station.panel().wish().percent;
  promise(percent >= 0.0 && percent <= runtime::kHighestOverride, "an override out of its range");
  read_as_schedule(text);
  static_cast<void>(studies::identify::parse_columns(text));
}

}  // namespace operator_target

const Target kOperator{"operator", operator_target::run};

}  // namespace twin::fuzz
