#include "operator/control_socket.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

#include <cstring>

#include "tests/support/temp_folder.hpp"

namespace twin::operator_station {
namespace control_socket_test {

using ::testing::HasSubstr;

std::string echo(std::string_view line) { return "<" + std::string(line) + ">"; }

sockaddr_un address_of(const std::filesystem::path& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, path.c_str(), sizeof(address.sun_path) - 1);
  return address;
}

/// A client of a socket that is served between its steps, in this thread.
class Client {
 public:
  Client(ControlSocket& server, const std::filesystem::path& path)
      : server_(server), connection_(::socket(AF_UNIX, SOCK_STREAM, 0)) {
    const sockaddr_un address = address_of(path);
    EXPECT_EQ(
        ::connect(connection_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)),
        0);
    serve();
  }
  void send(const std::string& text) {
    EXPECT_EQ(::send(connection_.get(), text.data(), text.size(), MSG_NOSIGNAL),
              static_cast<ssize_t>(text.size()));
    serve();
  }
  /// What has come so far; "closed" once the server has.
  std::string receive() {
    char bytes[4096];
    const ssize_t count = ::recv(connection_.get(), bytes, sizeof(bytes), MSG_DONTWAIT);
    return count > 0 ? std::string(bytes, static_cast<std::size_t>(count))
                     : (count == 0 ? "closed" : "");
  }
  void serve() {
    for (int i = 0; i < 3; ++i) {
      std::vector<pollfd> polled;
      server_.add_to(polled);
      ::poll(polled.data(), polled.size(), 0);
      server_.serve(polled);
    }
  }

 private:
  ControlSocket& server_;
  Descriptor connection_;
};

struct ControlSocketTest : public ::testing::Test {
  test::TempFolder folder;
  std::filesystem::path path = folder / "control";
};

TEST_F(ControlSocketTest, IsForItsOwnerAloneAndGoneAtTheEnd) {
  {
    const auto server = ControlSocket::open(path, echo);
    ASSERT_TRUE(server) << to_string(server.error());
    struct stat status {};
    ASSERT_EQ(::lstat(path.c_str(), &status), 0);
    EXPECT_TRUE(S_ISSOCK(status.st_mode));
    EXPECT_EQ(status.st_mode & 0777, 0600U);
    EXPECT_EQ(status.st_uid, ::geteuid());
  }
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST_F(ControlSocketTest, AnswersLineByLineHoweverTheyCome) {
  const auto server = ControlSocket::open(path, echo);
  ASSERT_TRUE(server);
  Client client(**server, path);
  client.send("one\ntwo\nthr");
  EXPECT_EQ(client.receive(), "<one>\n<two>\n");
  client.send("ee\n");
  EXPECT_EQ(client.receive(), "<three>\n");
  Client other(**server, path);
  other.send("four\n");
  EXPECT_EQ(other.receive(), "<four>\n");
  EXPECT_EQ(client.receive(), "");
}

TEST_F(ControlSocketTest, ALineWithoutEndIsRefusedAndTheConnectionClosed) {
  const auto server = ControlSocket::open(path, echo);
  ASSERT_TRUE(server);
  Client client(**server, path);
  client.send(std::string(300, 'x'));
  client.serve();
  EXPECT_THAT(client.receive(), HasSubstr("too long"));
  EXPECT_EQ(client.receive(), "closed");
}

TEST_F(ControlSocketTest, OneTooManyIsToldSo) {
  const auto server = ControlSocket::open(path, echo);
  ASSERT_TRUE(server);
  std::vector<std::unique_ptr<Client>> clients;
  for (int i = 0; i < 8; ++i) {
    clients.push_back(std::make_unique<Client>(**server, path));
  }
  Client last(**server, path);
  EXPECT_THAT(last.receive(), HasSubstr("too many"));
  clients.pop_back();
  last.serve();
  Client next(**server, path);
  next.send("x\n");
  EXPECT_EQ(next.receive(), "<x>\n");
}

TEST_F(ControlSocketTest, ASecondRunDoesNotStealIt) {
  const auto first = ControlSocket::open(path, echo);
  ASSERT_TRUE(first);
  const auto second = ControlSocket::open(path, echo);
  ASSERT_FALSE(second);
  EXPECT_THAT(second.error().message, HasSubstr("another run listens"));
  Client client(**first, path);
  client.send("still\n");
  EXPECT_EQ(client.receive(), "<still>\n");
}

TEST_F(ControlSocketTest, ASocketThatWasLeftBehindIsTakenOver) {
  {
    const Descriptor left(::socket(AF_UNIX, SOCK_STREAM, 0));
    const sockaddr_un address = address_of(path);
    ASSERT_EQ(::bind(left.get(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
  }
  ASSERT_TRUE(std::filesystem::exists(path));
  const auto server = ControlSocket::open(path, echo);
  ASSERT_TRUE(server) << to_string(server.error());
  Client client(**server, path);
  client.send("x\n");
  EXPECT_EQ(client.receive(), "<x>\n");
}

TEST_F(ControlSocketTest, AFileOfThatNameIsLeftAlone) {
  folder.put("control", "mine");
  const auto server = ControlSocket::open(path, echo);
  ASSERT_FALSE(server);
  EXPECT_THAT(server.error().message, HasSubstr("something else"));
  EXPECT_TRUE(std::filesystem::is_regular_file(path));
}

TEST_F(ControlSocketTest, AFolderThatOthersMayChangeIsRefused) {
  using std::filesystem::perms;
  std::filesystem::create_directory(folder / "open");
  std::filesystem::permissions(folder / "open", perms::all);
  const auto server = ControlSocket::open(folder / "open/control", echo);
  ASSERT_FALSE(server);
  EXPECT_THAT(server.error().message, HasSubstr("others may change files"));
  // As in /tmp, where nobody may remove what is not his.
  std::filesystem::permissions(folder / "open", perms::all | perms::sticky_bit);
  EXPECT_TRUE(ControlSocket::open(folder / "open/control", echo));
}

TEST_F(ControlSocketTest, ANameThatIsTooLongIsRefused) {
  const auto server = ControlSocket::open(folder / std::string(200, 'x'), echo);
  ASSERT_FALSE(server);
  EXPECT_THAT(server.error().message, HasSubstr("1 to 107 characters"));
}

}  // namespace control_socket_test
}  // namespace twin::operator_station
