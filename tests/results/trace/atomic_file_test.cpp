#include "core/atomic_file.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <thread>

#include "tests/support/files.hpp"
#include "tests/support/synthetic_trace.hpp"
#include "tests/support/temp_folder.hpp"

namespace twin {
namespace atomic_file_test {

using test::content;
using test::put;
using test::TempFolder;
using testing::HasSubstr;

TEST(AtomicFile, TheOldContentStaysUntilCommit) {
  const TempFolder directory;
  const auto target = directory.path() / "summary.json";
  put(target, "old");
  auto file = AtomicFile::create(target, directory.path() / "summary.json.tmp");
  ASSERT_TRUE(file);
  ASSERT_TRUE(file->write("new"));
  EXPECT_EQ(content(target), "old");
  ASSERT_TRUE(file->commit());
  EXPECT_EQ(content(target), "new");
  EXPECT_FALSE(std::filesystem::exists(directory.path() / "summary.json.tmp"));
}

TEST(AtomicFile, AbandonedFileIsRemovedOrKeptUnderItsTemporaryName) {
  const TempFolder directory;
  const auto target = directory.path() / "a";
  const auto temporary = directory.path() / "a.partial";
  {
    auto file = AtomicFile::create(target, temporary);
    ASSERT_TRUE(file && file->write("lost"));
  }
  EXPECT_FALSE(std::filesystem::exists(temporary));
  {
    auto file = AtomicFile::create(target, temporary, OnAbandon::kKeep);
    ASSERT_TRUE(file && file->write("kept"));
  }
  EXPECT_EQ(content(temporary), "kept");
  EXPECT_FALSE(std::filesystem::exists(target));
}

TEST(AtomicFile, AMovedFileIsCommittedOnce) {
  const TempFolder directory;
  const auto target = directory.path() / "a";
  auto first = AtomicFile::create(target, directory.path() / "a.tmp");
  ASSERT_TRUE(first && first->write("x"));
  AtomicFile second = std::move(*first);
  first->abandon();
  ASSERT_TRUE(second.write("y"));
  ASSERT_TRUE(second.commit());
  EXPECT_EQ(content(target), "xy");
}

TEST(AtomicFile, TwoWritersOfOneFileCannotMix) {
  const TempFolder directory;
  const auto temporary = directory.path() / "a.tmp";
  auto first = AtomicFile::create(directory.path() / "a", temporary);
  ASSERT_TRUE(first);
  const auto second = AtomicFile::create(directory.path() / "a", temporary);
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().message, "another run is writing this file");
  first->abandon();
  EXPECT_TRUE(AtomicFile::create(directory.path() / "a", temporary));
}

TEST(AtomicFile, TheLockIsOnTheFileThatHasTheNameNotOnOneThatHadIt) {
  const TempFolder directory;
  const auto target = directory.path() / "a";
  const auto temporary = directory.path() / "a.tmp";
  for (int i = 0; i < 200; ++i) {
    // One thread commits while the other opens: whoever gets in must not empty what is whole.
    auto first = AtomicFile::create(target, temporary);
    ASSERT_TRUE(first && first->write("whole"));
    std::jthread second([&] {
      for (int j = 0; j < 20; ++j) {
        static_cast<void>(AtomicFile::create(target, temporary));
      }
    });
    ASSERT_TRUE(first->commit());
    second.join();
    ASSERT_EQ(content(target), "whole");
  }
}

TEST(AtomicFile, ALinkOrFifoInThePlaceOfTheTemporaryIsRefused) {
  const TempFolder directory;
  const auto precious = directory.path() / "precious";
  put(precious, "kept");
  std::filesystem::create_symlink(precious, directory.path() / "a.tmp");
  const auto linked = write_whole_file(directory.path() / "a", "text");
  ASSERT_FALSE(linked);
  EXPECT_EQ(linked.error().message, "cannot write: there is a symbolic link of this name");
  EXPECT_EQ(content(precious), "kept");
  ASSERT_EQ(mkfifo((directory.path() / "b.tmp").c_str(), 0600), 0);
  const auto piped = write_whole_file(directory.path() / "b", "text");
  ASSERT_FALSE(piped);
  EXPECT_EQ(piped.error().message, "cannot write: there is a FIFO of this name");
}

TEST(AtomicFile, AProcessThatIsEndedRemovesWhatHasATemporaryName) {
  const TempFolder directory;
  auto file = AtomicFile::create(directory.path() / "a", directory.path() / "a.tmp");
  auto kept =
      AtomicFile::create(directory.path() / "b", directory.path() / "b.partial", OnAbandon::kKeep);
  ASSERT_TRUE(file && kept);
  TemporaryName::remove_all();
  EXPECT_FALSE(std::filesystem::exists(directory.path() / "a.tmp"));
  EXPECT_TRUE(std::filesystem::exists(directory.path() / "b.partial"));
}

TEST(AtomicFile, MissingDirectoryIsNamed) {
  const auto file = AtomicFile::create("/nonexistent/a", "/nonexistent/a.tmp");
  ASSERT_FALSE(file);
  EXPECT_EQ(to_string(file.error()),
            "/nonexistent/a.tmp: cannot open for writing: No such file or directory");
}

TEST(AtomicFile, ADirectoryInThePlaceOfTheTargetIsAnError) {
  const TempFolder directory;
  std::filesystem::create_directory(directory.path() / "a");
  const auto written = write_whole_file(directory.path() / "a", "text");
  ASSERT_FALSE(written);
  EXPECT_THAT(written.error().message, HasSubstr("something else than a file"));
  EXPECT_FALSE(std::filesystem::exists(directory.path() / "a.tmp"));
}

TEST(AtomicFile, AFullDiskIsAnErrorAndLeavesNoWholeFile) {
  const TempFolder directory;
  const auto target = directory.path() / "a";
  auto file = AtomicFile::create(target, directory.path() / "a.partial", OnAbandon::kKeep);
  ASSERT_TRUE(file);
  const test::FileSizeLimit limit(100000);
  Expected<void> written;
  for (int i = 0; i < 300 && written; ++i) {
    written = file->write(std::string(1000, 'x'));
  }
  ASSERT_FALSE(written);
  EXPECT_EQ(to_string(written.error()), target.string() + ": cannot write: File too large");
  EXPECT_FALSE(file->write("more"));
  EXPECT_FALSE(file->commit());
  EXPECT_FALSE(std::filesystem::exists(target));
  EXPECT_EQ(std::filesystem::file_size(directory.path() / "a.partial"), 100000U);
}

}  // namespace atomic_file_test
}  // namespace twin
