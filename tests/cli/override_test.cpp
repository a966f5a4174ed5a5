#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <thread>

#include "core/descriptor.hpp"
#include "core/json.hpp"
#include "core/limits.hpp"
#include "tests/support/cli_fixture.hpp"
#include "tests/support/files.hpp"
#include "tests/support/trace_rows.hpp"

namespace twin::cli {
namespace override_test {

using json = twin::Json;
using ::testing::HasSubstr;

class OverrideCli : public test::CliTest {
 protected:
  json summary() const { return parse_json(test::content(folder / "out/summary.json")); }
  test::ChildResult run(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments{"run",   "ok.nc", "--hal",     "ideal",
                                       "--out", "out",   "--no-plots"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return twin(arguments);
  }
};

TEST_F(OverrideCli, AScheduleChangesTheTimeAndIsInTheSummary) {
  ASSERT_EQ(run({}).status, 0);
  const double plain = summary()["machining_time_s"];
  EXPECT_FALSE(summary().contains("override"));
  const auto result = run({"--override", "0.1:50,0.3:0,1.3:50"});
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("feed override"));
  EXPECT_GT(summary()["machining_time_s"].get<double>(), plain + 1.0);
  EXPECT_NEAR(summary()["planned_time_s"].get<double>(), plain, 0.001);
  ASSERT_EQ(summary()["override"].size(), 3U);
  EXPECT_EQ(summary()["override"][1]["percent"], 0.0);
  EXPECT_EQ(summary()["override"][1]["from_s"], 0.3);
  const std::string first = test::content(folder / "out/trace.csv");
  ASSERT_EQ(run({"--override", "0.1:50,0.3:0,1.3:50"}).status, 0);
  EXPECT_EQ(test::content(folder / "out/trace.csv"), first);
}

TEST_F(OverrideCli, AWrongScheduleIsRefused) {
  expect_refusal(run({"--override", "0:100,5"}), 2, "'5' is not SECONDS:PERCENT");
  expect_refusal(run({"--control", "socket"}), 2, "--control is for runs on the wall clock");
}

TEST_F(OverrideCli, CheckSaysTheMachiningTime) {
  ASSERT_EQ(run({}).status, 0);
  const auto checked = twin({"check", "ok.nc"});
  EXPECT_THAT(checked.out, HasSubstr(fmt::format("machining time {:.3f} s",
                                                 summary()["planned_time_s"].get<double>())));
}

/// Sends a line to the socket of a run, once it is there; returns the answer.
json ask(const std::filesystem::path& path, const std::string& line) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, path.c_str(), sizeof(address.sun_path) - 1);
  for (int i = 0; i < 500; ++i) {
    const Descriptor connection(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
    if (::connect(connection.get(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)) ==
        0) {
      const std::string text = line + "\n";
      EXPECT_EQ(::send(connection.get(), text.data(), text.size(), MSG_NOSIGNAL),
                static_cast<ssize_t>(text.size()));
      char bytes[1024];
      const ssize_t count = ::recv(connection.get(), bytes, sizeof(bytes), 0);
      return parse_json(std::string(bytes, static_cast<std::size_t>(std::max<ssize_t>(count, 0))));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  ADD_FAILURE() << "nobody listens";
  return {};
}

TEST_F(OverrideCli, TheControlSocketHoldsAndGoesOnWhileItMoves) {
  folder.put("line.nc", "G01 X10 F600\n");
  const auto socket = folder / "control";
  test::Child child({"run", "line.nc", "--hal", "ideal", "--out", "out", "--no-plots", "--realtime",
                     "--quiet", "--control", "control"},
                    {folder.path(), {}});
  const auto wait_for = [&](const char* state) {
    for (int i = 0; i < 500; ++i) {
      if (ask(socket, "status").value("state", "") == state) {
        return;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    ADD_FAILURE() << "never " << state;
  };
  wait_for("moving");
  struct stat status {};
  ASSERT_EQ(::stat(socket.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0600U);
  ask(socket, "hold");
  wait_for("holding");
  ask(socket, "override 200");
  ask(socket, "resume");
  const auto result = child.wait();
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_FALSE(exists("control"));
  const test::TraceRows rows(folder / "out/trace.csv");
  EXPECT_EQ(rows.last("x_cmd_mm"), 10.0);
  test::expect_within_limits(rows.column("x_cmd_mm"), 0.001, Limits{}, 20.0);
  const json overrides = summary()["override"];
  ASSERT_EQ(overrides.size(), 2U);
  EXPECT_EQ(overrides[0]["percent"], 0.0);
  EXPECT_EQ(overrides[1]["percent"], 200.0);
}

}  // namespace override_test
}  // namespace twin::cli
