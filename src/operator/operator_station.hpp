#pragma once

#include <filesystem>
#include <memory>
#include <thread>

#include "core/descriptor.hpp"
#include "core/error.hpp"
#include "operator/control_socket.hpp"
#include "operator/terminal.hpp"
#include "runtime/operator_panel.hpp"

namespace twin::operator_station {

/// What an operator works with while a run is under way: the keys of the terminal, a line on it,
/// and a control socket; in a thread of its own, which the run never waits for.
class OperatorStation {
 public:
  struct Options {
    std::filesystem::path socket;  ///< empty: none
    bool has_keys = true;          ///< if stdin is a terminal
    bool shows_status = true;      ///< if stderr is a terminal too
  };

  static Expected<std::unique_ptr<OperatorStation>> open(const Options& options,
                                                         runtime::OperatorPanel& panel);
  OperatorStation(const OperatorStation&) = delete;
  OperatorStation& operator=(const OperatorStation&) = delete;
  ~OperatorStation();

  /// Whether it writes on the terminal.
  bool shows_status() const noexcept { return shows_status_; }

 private:
  OperatorStation(const Options& options, runtime::OperatorPanel& panel,
                  std::unique_ptr<ControlSocket> socket, Descriptor wake);
  void work(const std::stop_token& stop);
  void read_keys();

  runtime::OperatorPanel& panel_;
  std::unique_ptr<ControlSocket> socket_;
  std::unique_ptr<RawTerminal> terminal_;
  bool has_keys_;
  bool shows_status_;
  Descriptor wake_;
  std::jthread thread_;
};

}  // namespace twin::operator_station
