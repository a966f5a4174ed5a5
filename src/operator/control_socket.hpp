#pragma once

#include <poll.h>
#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/descriptor.hpp"
#include "core/error.hpp"

namespace twin::operator_station {

/// A Unix domain socket for the user who started the run, and for nobody else: lines in, lines out.
///
/// The folder must be one that others cannot rename files in. The socket has mode 0600, and
/// SO_PEERCRED tells who connects. A socket at which nobody listens is replaced, and one at which
/// another run listens is not. Nothing in here waits, apart from poll() of the caller.
class ControlSocket {
 public:
  using Answer = std::function<std::string(std::string_view)>;

  /// @param answer  gets a line without its end and returns the answer, without its end too
  static Expected<std::unique_ptr<ControlSocket>> open(const std::filesystem::path& path,
                                                       Answer answer);
  ControlSocket(const ControlSocket&) = delete;
  ControlSocket& operator=(const ControlSocket&) = delete;
  /// Removes the socket.
  ~ControlSocket();

  /// Appends what to poll for.
  void add_to(std::vector<pollfd>& polled) const;
  /// Serves what poll() has found.
  void serve(const std::vector<pollfd>& polled);

 private:
  struct Client {
    std::unique_ptr<Descriptor> connection;
    std::string line;  // that has not ended yet
  };

  ControlSocket(std::filesystem::path path, int listening, Answer answer);
  void welcome();
  bool hear(Client& client);

  std::filesystem::path path_;
  Descriptor listening_;
  Answer answer_;
  dev_t device_ = 0;  // of the socket's file
  ino_t inode_ = 0;
  std::vector<Client> clients_;
};

}  // namespace twin::operator_station
