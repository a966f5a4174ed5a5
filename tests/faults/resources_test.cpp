#include <fcntl.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>

#include "tests/faults/whole_files.hpp"
#include "tests/support/cli_fixture.hpp"

// What the system refuses: output, descriptors, memory, space, places.
namespace twin::faults {
namespace resources_test {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::vector<std::string> kRun{"run", "ok.nc", "--out", "out", "--quiet"};
const std::vector<std::string> kRunOnly{"run", "ok.nc", "--out", "out", "--quiet", "--no-plots"};

class Refused : public test::CliTest {
 protected:
  test::ChildResult run(const std::vector<std::string>& command,
                        const std::function<void()>& prepare) const {
    return test::run_twin(command, {folder.path(), {}, prepare});
  }
  /// One line says why, and nothing poses as whole.
  void expect_told(const test::ChildResult& result) const {
    EXPECT_EQ(result.status, 1) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_THAT(result.err, ::testing::StartsWith("twin: "));
    EXPECT_THAT(test::broken_files(folder.path()), IsEmpty());
  }
};

std::function<void()> limit(__rlimit_resource_t resource, rlim_t most) {
  return [=] {
    const rlimit both{most, most};
    setrlimit(resource, &both);
  };
}

void full_output() { dup2(open("/dev/full", O_WRONLY), STDOUT_FILENO); }

// Standard output.

TEST_F(Refused, AFullStandardOutputIsAnErrorOfEveryCommandThatPrints) {
  ASSERT_EQ(twin({"run", "ok.nc", "--out", "earlier", "--no-plots", "--quiet"}).status, 0);
  folder.put("short.nc", "G01 X1 F1200\nX0 Y1\nM30\n");
  folder.put("jobs.jsonl", R"({"program": "short.nc", "hal": "ideal"})"
                           "\n");
  folder.put("sweep.toml",
             "program = \"short.nc\"\nhal = \"ideal\"\nfeedrate_mm_per_min = [600, 900]\n");
  const std::vector<std::vector<std::string>> commands{
      {"--help"},
      {"--version"},
      {"run", "--help"},
      {"run", "ok.nc", "--out", "out", "--no-plots"},
      {"plan", "ok.nc", "--out", "plan", "--no-plots"},
      {"check", "ok.nc"},
      {"compare", "ok.nc", "dolphin.nc", "--out", "compare"},
      {"circle", "--hal", "ideal", "--out", "circle", "--no-plots"},
      {"convert", "ok.nc", "--to", "fanuc", "--out", "converted.nc"},
      {"run", "ok.nc", "--trace", "hdf5", "--out", "hdf5", "--no-plots"},
      {"report", "earlier"},
      {"batch", "jobs.jsonl", "--store", "store"},
      {"sweep", "sweep.toml", "--list"},
      {"sweep", "sweep.toml", "--out", "sweep"},
      {"compensate", "short.nc", "--out", "c.csv"},
      {"rig", "check", "--rig", "emulated"},
      {"rig", "probe", "--rig", "emulated"},
      {"rig", "monitor", "--rig", "emulated"},
      {"rig", "emulate", "--for", "0.1", "--rig-name", "/twin-full-" + std::to_string(getpid())}};
  for (const auto& command : commands) {
    const auto result = run(command, full_output);
    EXPECT_EQ(result.status, 1) << command.back();
    EXPECT_EQ(result.err, "twin: standard output: cannot write: No space left on device\n")
        << command.front() << ' ' << command.back();
  }
  EXPECT_TRUE(exists("out/summary.json"));  // the results are files
}

TEST_F(Refused, ClosedStandardStreamsAreNotWrittenIntoResults) {
  const auto result = run({"run", "ok.nc", "--out", "out"}, [] {
    for (const int stream : {0, 1, 2}) {
      close(stream);
    }
  });
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(test::broken_files(folder / "out"), IsEmpty());
  EXPECT_TRUE(exists("out/plots/contour.png"));
  EXPECT_EQ(run(kRun,
                [] {
                  for (const int stream : {0, 1, 2}) {
                    close(stream);
                  }
                })
                .status,
            0);  // nothing was to be printed
}

TEST_F(Refused, AReaderThatHasGoneIsAnErrorAndNoSignal) {
  const auto result = run({"check", "ok.nc"}, [] {
    int ends[2];
    if (pipe(ends) == 0) {
      dup2(ends[1], STDOUT_FILENO);
      close(ends[0]);
      close(ends[1]);
    }
  });
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.err, "twin: standard output: cannot write: Broken pipe\n");
}

TEST_F(Refused, AnEmptyNameOfTheControlSocketIsBadUsage) {
  expect_refusal(twin({"run", "ok.nc", "--realtime", "--control", "", "--out", "out"}), 2,
                 "--control: the socket needs a name");
}

// Descriptors, memory, space.

TEST_F(Refused, WithAnyNumberOfDescriptorsItWorksOrSaysWhyNot) {
  bool has_worked = false;
  for (rlim_t most = 4; most < 24; most += most < 12 ? 1 : 4) {
    const auto result = run(most % 4 == 0 ? kRun : kRunOnly, limit(RLIMIT_NOFILE, most));
    if (result.status == 127) {
      continue;  // not even the program's libraries could be opened
    }
    has_worked = has_worked || result.status == 0;
    if (result.status != 0) {
      expect_told(result);
    }
  }
  EXPECT_TRUE(has_worked);
}

TEST_F(Refused, WithFewDescriptorsASweepAndItsHdf5WorkOrSayWhyNot) {
  folder.put("short.nc", "G01 X1 F1200\nX0 Y1\nM30\n");
  folder.put("sweep.toml",
             "program = \"short.nc\"\ntrace = \"hdf5\"\nhal = \"ideal\"\nfeedrate_mm_per_min = "
             "[600, 900]\n");
  for (const rlim_t most : {6U, 9U, 12U, 40U}) {
    const auto result =
        run({"sweep", "sweep.toml", "--out", "out", "--quiet"}, limit(RLIMIT_NOFILE, most));
    if (result.status != 127 && most < 40) {
      EXPECT_LT(result.status, 128) << most << ": " << result.err;
      EXPECT_THAT(test::broken_files(folder.path()), IsEmpty()) << most;
    }
    if (most == 40) {
      EXPECT_EQ(result.status, 0) << result.err;
    }
  }
}

TEST_F(Refused, WithAnyAmountOfMemoryItWorksOrSaysWhyNot) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer reserves more memory than there is";
#endif
  // With less than some 50 MB a shared library ends the process before the program begins.
  for (const rlim_t megabytes : {64U, 80U, 96U, 128U, 256U}) {
    const auto result = run(megabytes == 128 ? kRun : kRunOnly, limit(RLIMIT_AS, megabytes << 20U));
    if (result.status != 0 && result.status != 127) {
      EXPECT_LT(result.status, 128) << megabytes << " MB: " << result.err;
      EXPECT_THAT(test::broken_files(folder.path()), IsEmpty());
    }
  }
}

TEST_F(Refused, AFullDiskIsToldAndLeavesNothingThatPosesAsWhole) {
  std::filesystem::create_directory(folder / "disk");
  const std::string disk = folder / "disk";
  for (const char* size : {"size=8k", "size=64k", "size=200k", "size=400k"}) {
    const auto result = run({"run", "ok.nc", "--out", "disk/out", "--quiet"}, [&] {
      if (unshare(CLONE_NEWNS) != 0 || mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) ||
          mount("none", disk.c_str(), "tmpfs", 0, size)) {
        _exit(77);
      }
    });
    if (result.status == 77) {
      GTEST_SKIP() << "no file system may be mounted here";
    }
    EXPECT_EQ(result.status, 1) << size << result.err;
    EXPECT_THAT(result.err, ::testing::StartsWith("twin: "));
  }
}

TEST_F(Refused, AStoreOfResultsThatIsFullIsToldAndLeavesNothingThatPosesAsWhole) {
#ifdef __SANITIZE_THREAD__
  GTEST_SKIP() << "the thread sanitizer's own files do not survive a limit of file size";
#endif
  folder.put("short.nc", "G01 X1 F1200\nX0 Y1\nM30\n");
  folder.put("jobs.jsonl", R"({"program": "short.nc", "hal": "ideal", "trace": "hdf5"})"
                           "\n");
  for (const long most : {100L, 2000L}) {
    const auto result = test::run_twin({"batch", "jobs.jsonl", "--store", "store", "--quiet"},
                                       {folder.path(), most});
    EXPECT_EQ(result.status, 1) << most << result.err;
    EXPECT_THAT(result.err, ::testing::StartsWith("twin: ")) << most;
    EXPECT_THAT(test::broken_files(folder.path()), IsEmpty()) << most;
  }
  EXPECT_EQ(twin({"batch", "jobs.jsonl", "--store", "store", "--quiet"}).status, 0);
}

TEST_F(Refused, ALimitOfFileSizeIsToldAndLeavesNothingThatPosesAsWhole) {
#ifdef __SANITIZE_THREAD__
  GTEST_SKIP() << "the thread sanitizer's own files do not survive a limit of file size";
#endif
  for (const long most : {100L, 5000L, 30000L, 60000L}) {
    const auto result = test::run_twin(kRun, {folder.path(), most});
    EXPECT_EQ(result.status, 1) << most << result.err;
    EXPECT_THAT(test::broken_files(folder / "out"), IsEmpty()) << most;
  }
}

// What others have put in the way.

struct Obstacle {
  const char* name;
  std::function<void(const std::filesystem::path&)> put;
};

void PrintTo(const Obstacle& obstacle, std::ostream* out) { *out << obstacle.name; }

class InTheWay : public Refused, public ::testing::WithParamInterface<Obstacle> {};

TEST_P(InTheWay, OfATemporaryNameIsRefusedAndStaysAsItIs) {
  const auto precious = folder.put("precious", "of somebody else\n");
  for (const char* name : {"trace.partial.csv", "summary.json.tmp"}) {
    std::filesystem::remove_all(folder / "out");
    std::filesystem::create_directories(folder / "out");
    GetParam().put(folder / "out" / name);
    const auto result = twin({"run", "ok.nc", "--out", "out", "--no-plots", "--quiet"});
    expect_told(result);
    EXPECT_THAT(result.err, HasSubstr(name));
    EXPECT_EQ(test::content(precious), "of somebody else\n");
  }
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, InTheWay,
    ::testing::Values(
        Obstacle{"folder", [](const auto& place) { std::filesystem::create_directory(place); }},
        Obstacle{"link",
                 [](const auto& place) { std::filesystem::create_symlink("../precious", place); }},
        Obstacle{"dangling",
                 [](const auto& place) { std::filesystem::create_symlink("nowhere", place); }},
        Obstacle{"fifo", [](const auto& place) { mkfifo(place.c_str(), 0600); }}),
    [](const auto& test) { return test.param.name; });

TEST_F(Refused, AFolderOfAnotherUserIsNamed) {
  if (geteuid() != 0) {
    GTEST_SKIP() << "only root can become another user";
  }
  std::filesystem::create_directories(folder / "out/plots");
  std::filesystem::permissions(folder.path(), std::filesystem::perms(0755));
  const auto result = run(kRun, [] { setuid(65534); });
  expect_told(result);
  EXPECT_THAT(result.err, HasSubstr("Permission denied"));
}

TEST_F(Refused, TwoRunsInOneFolderDoNotMix) {
  folder.put("long.nc", "G01 X40 F3000\nX-40\nX0\nM30\n");
  const std::vector<std::string> command{"run", "long.nc", "--out", "out", "--no-plots", "--quiet"};
  for (int i = 0; i < 3; ++i) {
    test::Child first(command, {folder.path(), {}});
    std::filesystem::create_directory(folder / "second");
    auto other = command;
    other[1] = "../long.nc";
    other[3] = "../out";
    test::Child second(other, {folder / "second", {}});
    const auto a = first.wait();
    const auto b = second.wait();
    EXPECT_TRUE(a.status == 0 || b.status == 0) << a.err << b.err;
    for (const auto& result : {a, b}) {
      if (result.status != 0) {
        EXPECT_THAT(result.err, HasSubstr("another run is writing this file"));
      }
    }
    EXPECT_THAT(test::broken_files(folder / "out"), IsEmpty());
    std::filesystem::remove_all(folder / "second");
  }
}

}  // namespace resources_test
}  // namespace twin::faults
