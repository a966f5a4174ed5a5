#include <sys/stat.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <thread>

#include "tests/faults/whole_files.hpp"
#include "tests/support/cli_fixture.hpp"

// A signal ends every command in every phase, with one line and nothing left behind.
namespace twin::faults {
namespace told_to_end_test {

using Clock = std::chrono::steady_clock;
using ::testing::IsEmpty;

// The promise is 0.2 s; a machine that is busy with other tests takes longer to do anything. Each of
// these commands would go on for several times as long.
constexpr auto kPromise = std::chrono::milliseconds(1000);

struct Row {
  const char* name;
  std::vector<std::string> command;
  const char* sign;  ///< the name of a file or folder that shows the phase; empty: after a moment
};

void PrintTo(const Row& row, std::ostream* out) { *out << row.name; }

class ToldToEnd : public test::CliTest, public ::testing::WithParamInterface<Row> {
 protected:
  /// A flower of short blocks.
  void put_long_program(int blocks) const {
    std::string text = "G64\n";
    for (int i = 0; i < blocks; ++i) {
      const double a = i * 0.0005;
      const double r = 60.0 * (1.0 + 0.2 * std::sin(7.0 * a));
      text += "G01 X" + std::to_string(r * std::cos(a)) + " Y" + std::to_string(r * std::sin(a)) +
              " F3000\n";
    }
    folder.put("long.nc", text + "M30\n");
  }

  bool has_sign(const std::string& sign) const {
    std::error_code ignored;
    const std::filesystem::recursive_directory_iterator entries(folder.path(), ignored);
    return std::any_of(begin(entries), end(entries), [&](const auto& entry) {
      return entry.path().filename().string().starts_with(sign);
    });
  }

  /// Waits until the child is in the phase and has its own handler of SIGTERM.
  void wait_for(const std::string& sign, pid_t child) const {
    for (int i = 0; i < 4000; ++i) {
      const std::string status = test::content("/proc/" + std::to_string(child) + "/status");
      const std::size_t at = status.find("SigCgt:");
      const bool is_caught = at != std::string::npos &&
                             (std::stoull(status.substr(at + 7), nullptr, 16) >> 14U & 1U) != 0;
      if (is_caught && (sign.empty() || has_sign(sign))) {
        break;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(sign.empty() ? 200 : 20));
  }
};

TEST_P(ToldToEnd, EndsSoonWithOneLineAndLeavesNothingBehind) {
  if (GetParam().command[1] == "long.nc") {
    put_long_program(400000);
  }
  folder.put("sweep.toml", R"(program = "dolphin.nc"
[grid]
"servo.x.kp_per_s" = { from = 100, to = 200, count = 400 }
)");
  if (std::string(GetParam().name).starts_with("render")) {
    ASSERT_EQ(twin({"run", "dolphin.nc", "--out", "earlier", "--no-plots", "--quiet"}).status, 0);
  }
  test::Child child(GetParam().command, {folder.path(), {}});
  wait_for(GetParam().sign, child.pid());
  const auto begin = Clock::now();
  child.signal(SIGTERM);
  const auto result = child.wait();
  EXPECT_LT(Clock::now() - begin, kPromise);
  EXPECT_EQ(result.status, 130);
  EXPECT_THAT(result.err, ::testing::MatchesRegex("twin: .*(interrupted|not confirmed)[^\n]*\n"));
  EXPECT_THAT(test::broken_files(folder / "out"), IsEmpty());
  for (const std::string& name : test::unfinished_files(folder.path())) {
    EXPECT_THAT(name, ::testing::HasSubstr(".partial."));
  }
  EXPECT_THAT(test::processes_in(folder.path()), IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(
    Phases, ToldToEnd,
    ::testing::Values(
        Row{"check", {"check", "long.nc"}, ""},
        Row{"plan", {"plan", "long.nc", "--out", "out", "--quiet"}, ""},
        Row{"plots", {"plan", "dolphin.nc", "--out", "out", "--quiet"}, ".unfinished_"},
        Row{"convert", {"convert", "long.nc", "--to", "fanuc", "--out", "out/x.nc"}, ""},
        Row{"compare", {"compare", "dolphin.nc", "--out", "out"}, ".unfinished_"},
        Row{"reproduce", {"reproduce", "--out", "out"}, ".unfinished_"},
        Row{"tables", {"identify", "--tables", "--out", "out/x.toml"}, "out"},
        Row{"sweep", {"sweep", "sweep.toml", "--out", "out", "--quiet"}, "twin-store.json"},
        Row{"tune", {"tune", "dolphin.nc", "--out", "out", "--quiet"}, "twin-store.json"},
        Row{"compensate", {"compensate", "dolphin.nc", "--out", "out/c.csv", "--quiet"}, ""},
        Row{"render_video", {"render", "earlier", "--no-plots", "--video"}, "video.mp4.tmp"}),
    [](const auto& test) { return test.param.name; });

TEST_F(ToldToEnd, AProgramThatNeverComesIsNotWaitedFor) {
  ASSERT_EQ(mkfifo((folder / "never.nc").c_str(), 0600), 0);
  test::Child child({"run", "never.nc", "--out", "out"}, {folder.path(), {}});
  wait_for("", child.pid());
  child.signal(SIGINT);
  EXPECT_EQ(child.wait().status, 130);
}

TEST_F(ToldToEnd, ANohupStaysDeafToSighup) {
  test::Child child({"run", "ok.nc", "--realtime", "--out", "out", "--no-plots", "--quiet"},
                    {folder.path(), {}, [] { std::signal(SIGHUP, SIG_IGN); }});
  wait_for("", child.pid());
  child.signal(SIGHUP);
  EXPECT_EQ(child.wait().status, 0);
}

}  // namespace told_to_end_test
}  // namespace twin::faults
