#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include "core/descriptor.hpp"
#include "core/json.hpp"
#include "tests/support/cli_fixture.hpp"
#include "tests/support/trace_rows.hpp"

// --publish sends the rows of a run as they come; --view is for the wall clock.
namespace twin::cli {
namespace publish_test {

using ::testing::HasSubstr;

class Publish : public test::CliTest {
 protected:
  Publish() : socket(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const int room = 8 << 20;
    setsockopt(socket.get(), SOL_SOCKET, SO_RCVBUF, &room, sizeof(room));
    EXPECT_EQ(bind(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
    socklen_t size = sizeof(address);
    EXPECT_EQ(getsockname(socket.get(), reinterpret_cast<sockaddr*>(&address), &size), 0);
    port = ntohs(address.sin_port);
  }

  Descriptor socket;
  int port = 0;
};

TEST_F(Publish, RowsAreThoseOfTheTrace) {
  const auto result = twin({"run", "ok.nc", "--out", "out", "--no-plots", "--no-report", "--quiet",
                            "--publish", "udp://127.0.0.1:" + std::to_string(port)});
  ASSERT_EQ(result.status, 0) << result.err;
  const test::TraceRows rows(folder / "out/trace.csv");
  std::array<char, 4096> text{};
  int received = 0;
  for (ssize_t size = 0; (size = recv(socket.get(), text.data(), text.size(), MSG_DONTWAIT)) > 0;
       ++received) {
    const auto json = parse_json(std::string_view(text.data(), static_cast<std::size_t>(size)));
    const auto row = static_cast<std::size_t>(std::lround(json["t_s"].get<double>() / 1e-3));
    ASSERT_EQ(json["timestamp"], json["t_s"]);
    ASSERT_EQ(json["x_cmd_mm"].get<double>(), rows.column("x_cmd_mm")[row]);
    ASSERT_EQ(json["contour_error_um"].get<double>(), rows.column("contour_error_um")[row]);
    if (received == 40) {
      break;  // one column is read anew for each row
    }
  }
  EXPECT_EQ(received, 40);
}

TEST_F(Publish, NobodyNeedListen) {
  socket = Descriptor();
  EXPECT_EQ(twin({"run", "ok.nc", "--out", "out", "--no-trace", "--quiet", "--publish",
                  "udp://127.0.0.1:" + std::to_string(port)})
                .status,
            0);
}

TEST_F(Publish, BadAddressesAreRefused) {
  for (const char* const address : {"127.0.0.1:9870", "udp://127.0.0.1", "udp://nowhere:1",
                                    "udp://127.0.0.1:0", "udp://127.0.0.1:99999"}) {
    expect_refusal(twin({"run", "ok.nc", "--out", "out", "--publish", address}), 2,
                   "such as udp://127.0.0.1:9870");
  }
}

TEST_F(Publish, ViewIsForTheWallClock) {
  expect_refusal(twin({"run", "ok.nc", "--out", "out", "--view", "0"}), 2,
                 "--view is for runs on the wall clock");
}

TEST_F(Publish, PortOfTheViewThatIsInUseIsNamed) {
  Descriptor listener(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  ASSERT_EQ(bind(listener.get(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
  ASSERT_EQ(listen(listener.get(), 1), 0);
  socklen_t size = sizeof(address);
  ASSERT_EQ(getsockname(listener.get(), reinterpret_cast<sockaddr*>(&address), &size), 0);
  expect_refusal(twin({"run", "ok.nc", "--out", "out", "--realtime", "--view",
                       std::to_string(ntohs(address.sin_port))}),
                 1, "is it in use?");
}

}  // namespace publish_test
}  // namespace twin::cli
