#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <chrono>
#include <csignal>
#include <cstring>
#include <memory>
#include <thread>

#include "core/descriptor.hpp"
#include "tests/support/cli_fixture.hpp"
#include "tests/support/files.hpp"

// Clients of the control socket that flood, never read, never end a line, or come in crowds: the
// run goes on, and an honest client is answered.
namespace twin::faults {
namespace hostile_clients_test {

using ::testing::HasSubstr;

class HostileClients : public test::CliTest {
 protected:
  Descriptor connect_to() const {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, (folder / "c").c_str(), sizeof(address.sun_path) - 1);
    for (int i = 0; i < 2000; ++i) {
      Descriptor connection(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
      if (::connect(connection.get(), reinterpret_cast<const sockaddr*>(&address),
                    sizeof(address)) == 0) {
        return connection;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    ADD_FAILURE() << "nobody listens";
    return Descriptor();
  }
  static void say(const Descriptor& to, const std::string& text) {
    [[maybe_unused]] const auto sent = ::send(to.get(), text.data(), text.size(), MSG_NOSIGNAL);
  }
  /// What comes within two seconds, up to a line end or the end.
  static std::string hear(const Descriptor& from) {
    std::string text;
    pollfd ready{from.get(), POLLIN, 0};
    while (!text.ends_with('\n') && ::poll(&ready, 1, 2000) > 0) {
      char bytes[512];
      const ssize_t count = ::recv(from.get(), bytes, sizeof(bytes), 0);
      if (count <= 0) {
        break;
      }
      text.append(bytes, static_cast<std::size_t>(count));
    }
    return text;
  }
};

TEST_F(HostileClients, DoNotDisturbTheRunNorAnHonestClient) {
  folder.put("long.nc", "G01 F3000 X60\nX-60\nM30\n");
  test::Child child(
      {"run", "long.nc", "--realtime", "--control", "c", "--out", "out", "--no-plots", "--quiet",
       "--set", "realtime.max_stall_ms=10000", "--set", "realtime.max_late_periods=100000"},
      {folder.path(), {}});
  {
    const Descriptor honest = connect_to();
    const Descriptor half = connect_to();
    say(half, "stat");  // and never the rest
    const Descriptor endless = connect_to();
    say(endless, std::string(10000, 'x'));
    const Descriptor deaf = connect_to();
    std::string flood;
    for (int i = 0; i < 2000; ++i) {
      flood += "status\n";
    }
    for (int i = 0; i < 200; ++i) {
      say(deaf, flood);
    }
    say(honest, "status\n");
    EXPECT_THAT(hear(honest), HasSubstr("\"state\""));
    EXPECT_THAT(hear(endless), HasSubstr("too long"));
    std::vector<std::unique_ptr<Descriptor>> crowd;
    for (int i = 0; i < 50; ++i) {
      crowd.push_back(std::make_unique<Descriptor>(connect_to()));
    }
    EXPECT_THAT(hear(*crowd.back()), HasSubstr("too many connections"));
    say(honest, "override 90\n");
    EXPECT_THAT(hear(honest), HasSubstr("90"));
  }
  const auto result = child.wait();
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_TRUE(exists("out/trace.csv"));
  EXPECT_FALSE(exists("c"));
}

}  // namespace hostile_clients_test
}  // namespace twin::faults
