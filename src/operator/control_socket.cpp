#include "operator/control_socket.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>
#include <utility>

#include "core/atomic_file.hpp"

namespace twin::operator_station {
namespace {

constexpr std::size_t kMostClients = 8;
constexpr std::size_t kLongestLine = 256;  // [bytes]

// Until it is tried again to take a connection for which there was no descriptor.
constexpr auto kNoDescriptor = std::chrono::milliseconds(50);

tl::unexpected<Error> refused(const std::filesystem::path& path, const std::string& why) {
  return tl::unexpected(Error{ErrorCode::kFile, why, path.string(), 0, 0});
}

Expected<sockaddr_un> address_of(const std::filesystem::path& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string name = path.string();
  if (name.empty() || name.size() >= sizeof(address.sun_path)) {
    return refused(path, fmt::format("the name of a control socket has 1 to {} characters",
                                     sizeof(address.sun_path) - 1));
  }
  std::memcpy(address.sun_path, name.c_str(), name.size() + 1);
  return address;
}

const sockaddr* as_generic(const sockaddr_un& address) {
  return reinterpret_cast<const sockaddr*>(&address);  // as the socket interface wants it
}

/// Others must not be able to put something else in the socket's place.
Expected<void> check_folder(int folder, const std::filesystem::path& path) {
  struct stat status {};
  if (::fstat(folder, &status) != 0) {
    return file_error(path, "look at this folder", errno);
  }
  const bool is_trusted = status.st_uid == ::geteuid() || status.st_uid == 0;
  const bool is_open = (status.st_mode & (S_IWGRP | S_IWOTH)) != 0;
  if (!is_trusted || (is_open && (status.st_mode & S_ISVTX) == 0)) {
    return refused(path, "others may change files in this folder: no place for a control socket");
  }
  return {};
}

/// Nothing else has this name, or a socket at which nobody listens any more, which goes.
Expected<void> clear_place(const std::filesystem::path& path, const sockaddr_un& address) {
  struct stat status {};
  if (::lstat(path.c_str(), &status) != 0) {
    return errno == ENOENT ? Expected<void>{} : file_error(path, "look at this file", errno);
  }
  if (!S_ISSOCK(status.st_mode) || status.st_uid != ::geteuid()) {
    return refused(path, "there is something else than a control socket of yours");
  }
  const Descriptor probe(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (::connect(probe.get(), as_generic(address), sizeof(address)) == 0 || errno != ECONNREFUSED) {
    return refused(path, "another run listens at this control socket");
  }
  ::unlink(path.c_str());
  return {};
}

/// Locks the folder, so that two runs that start together do not replace each other's socket.
bool lock(int folder) {
  for (int i = 0; i < 100; ++i) {
    if (::flock(folder, LOCK_EX | LOCK_NB) == 0) {
      return true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

bool is_of_this_user(int connection) {
  ucred peer{};
  socklen_t size = sizeof(peer);
  return ::getsockopt(connection, SOL_SOCKET, SO_PEERCRED, &peer, &size) == 0 &&
         (peer.uid == ::geteuid() || peer.uid == 0);
}

/// @returns false if the other end does not accept it at once
bool send_line(int connection, std::string line) {
  line += '\n';
  return ::send(connection, line.data(), line.size(), MSG_NOSIGNAL | MSG_DONTWAIT) ==
         static_cast<ssize_t>(line.size());
}

}  // namespace

Expected<std::unique_ptr<ControlSocket>> ControlSocket::open(const std::filesystem::path& path,
                                                             Answer answer) {
  TWIN_TRY(const sockaddr_un address, address_of(path));
  const std::filesystem::path parent = path.has_parent_path() ? path.parent_path() : ".";
  const Descriptor folder(::open(parent.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (folder.get() < 0) {
    return file_error(parent, "open this folder", errno);
  }
  TWIN_CHECK(check_folder(folder.get(), parent));
  if (!lock(folder.get())) {
    return refused(parent, "this folder is locked by another process");
  }
  TWIN_CHECK(clear_place(path, address));
  Descriptor listening(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  // Linux makes the file with the mode of the socket, so it never has a wider one.
  if (::fchmod(listening.get(), S_IRUSR | S_IWUSR) != 0 ||
      ::bind(listening.get(), as_generic(address), sizeof(address)) != 0 ||
      ::listen(listening.get(), static_cast<int>(kMostClients)) != 0) {
    return file_error(path, "listen at this control socket", errno);
  }
  return std::unique_ptr<ControlSocket>(
      new ControlSocket(path, listening.release(), std::move(answer)));
}

ControlSocket::ControlSocket(std::filesystem::path path, int listening, Answer answer)
    : path_(std::move(path)), listening_(listening), answer_(std::move(answer)) {
  struct stat status {};
  if (::lstat(path_.c_str(), &status) == 0) {
    device_ = status.st_dev;
    inode_ = status.st_ino;
  }
}

ControlSocket::~ControlSocket() {
  struct stat status {};
  if (::lstat(path_.c_str(), &status) == 0 && status.st_dev == device_ && status.st_ino == inode_) {
    ::unlink(path_.c_str());
  }
}

void ControlSocket::add_to(std::vector<pollfd>& polled) const {
  polled.push_back({listening_.get(), POLLIN, 0});
  for (const Client& client : clients_) {
    polled.push_back({client.connection->get(), POLLIN, 0});
  }
}

void ControlSocket::serve(const std::vector<pollfd>& polled) {
  const auto has_news = [&](int descriptor) {
    return std::any_of(polled.begin(), polled.end(), [&](const pollfd& entry) {
      return entry.fd == descriptor && entry.revents != 0;
    });
  };
  std::erase_if(clients_, [&](Client& client) {
    return has_news(client.connection->get()) && !hear(client);
  });
  if (has_news(listening_.get())) {
    welcome();
  }
}

void ControlSocket::welcome() {
  auto connection = std::make_unique<Descriptor>(
      ::accept4(listening_.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
  if (connection->get() < 0) {
    if (errno == EMFILE || errno == ENFILE) {  // whoever knocks goes on knocking
      std::this_thread::sleep_for(kNoDescriptor);
    }
    return;
  }
  if (!is_of_this_user(connection->get())) {
    return;
  }
  if (clients_.size() >= kMostClients) {
    send_line(connection->get(), R"({"error":"too many connections"})");
    return;
  }
  clients_.push_back({std::move(connection), {}});
}

/// Receives what a client has sent and answers its lines. @returns false to close the connection
bool ControlSocket::hear(Client& client) {
  char bytes[kLongestLine];
  const int connection = client.connection->get();
  const ssize_t count = ::recv(connection, bytes, sizeof(bytes), MSG_DONTWAIT);
  if (count <= 0) {
    return count < 0 && (errno == EAGAIN || errno == EINTR);
  }
  client.line.append(bytes, static_cast<std::size_t>(count));
  for (auto end = client.line.find('\n'); end != std::string::npos; end = client.line.find('\n')) {
    if (!send_line(connection, answer_(std::string_view(client.line).substr(0, end)))) {
      return false;
    }
    client.line.erase(0, end + 1);
  }
  if (client.line.size() > kLongestLine) {
    send_line(connection, R"({"error":"the line is too long"})");
    return false;
  }
  return true;
}

}  // namespace twin::operator_station
