#include "gcode/program_text.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <thread>

#include "gcode/reader.hpp"
#include "tests/support/program_text.hpp"
#include "tests/support/temp_folder.hpp"

namespace twin::gcode {
namespace program_text_test {

std::string bytes_of(const ProgramText& program) {
  std::string bytes(static_cast<std::size_t>(program.size()) + 10, '?');
  bytes.resize(*program.copy(0, bytes));
  return bytes;
}

/// Lines of a program, so many bytes or a few more.
std::string lines(std::size_t bytes) {
  std::string text;
  for (int i = 0; text.size() < bytes; ++i) {
    text += "G1 X" + std::to_string(i % 100) + " F600\n";
  }
  return text;
}

TEST(ProgramText, IsTheBytesOfTheFileInMemoryAndOnDisk) {
  const test::TempFolder folder;
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, ProgramText::kInMemory - 20,
                                 ProgramText::kInMemory + 20, 4 * ProgramText::kInMemory + 7}) {
    const std::string text = lines(size);
    const ProgramText program = test::text_of(folder.put("part.nc", text));
    EXPECT_EQ(program.size(), static_cast<std::int64_t>(text.size()));
    EXPECT_EQ(bytes_of(program), text);
    EXPECT_EQ(program.sha256(), ProgramText::from_text(text, "text").sha256());
    std::string middle(5, '?');
    const std::size_t at = text.size() / 2;
    EXPECT_EQ(*program.copy(static_cast<std::int64_t>(at), middle),
              std::min(text.size() - at, 5UL));
    EXPECT_EQ(middle.substr(0, std::min(text.size() - at, 5UL)), text.substr(at, 5));
    EXPECT_EQ(*program.copy(program.size() + 100, middle), 0U);
  }
}

TEST(ProgramText, StaysWhatItWasWhenTheFileIsChangedReplacedOrRemoved) {
  const test::TempFolder folder;
  for (const std::size_t size : {std::size_t{100}, 2 * ProgramText::kInMemory}) {
    const std::string text = lines(size);
    const auto file = folder.put("part.nc", text);
    const ProgramText program = test::text_of(file);
    EXPECT_FALSE(program.has_changed());
    std::ofstream(file, std::ios::in | std::ios::binary) << "G1 X999 F1\n";
    EXPECT_TRUE(program.has_changed());
    EXPECT_EQ(bytes_of(program), text);
    std::filesystem::remove(file);
    EXPECT_TRUE(program.has_changed());
    folder.put("part.nc", text);
    EXPECT_TRUE(program.has_changed());
    EXPECT_EQ(bytes_of(program), text);
  }
}

TEST(ProgramText, FifoIsReadOnceAndCanBeGoneThroughOften) {
  const test::TempFolder folder;
  const auto fifo = folder / "part.nc";
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  std::thread writer([&] { std::ofstream(fifo) << "G1 X1 F600\n" << std::flush << "X2\n"; });
  const ProgramText program = test::text_of(fifo);
  writer.join();
  for (int reading = 0; reading < 3; ++reading) {
    Reader reader(program);
    EXPECT_EQ((*reader.next())->end.x(), 1.0);
    EXPECT_EQ((*reader.next())->end.x(), 2.0);
    EXPECT_FALSE(reader.next()->has_value());
  }
  EXPECT_FALSE(program.has_changed());
}

TEST(ProgramText, WaitForAFifosWriterEndsWhenToldTo) {
  const test::TempFolder folder;
  const auto fifo = folder / "part.nc";
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  std::atomic<bool> stop{false};
  std::thread stopper([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    stop = true;
  });
  const auto refused = ProgramText::read(fifo, {.folder = {}, .stop = &stop});
  stopper.join();
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kInterrupted);
}

TEST(ProgramText, DeviceWithoutEndIsRefusedByItsFirstLine) {
  auto reader = Reader::open("/dev/zero");
  ASSERT_TRUE(reader);
  const auto refused = reader->next();
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("longer than 4096 characters"), std::string::npos);
}

TEST(ProgramText, MissingFileAndDirectoryAreFileErrorsWithTheirName) {
  const auto missing = ProgramText::read("no/such/program.nc");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::kFile);
  EXPECT_EQ(to_string(missing.error()),
            "no/such/program.nc: cannot open the NC program: No such file or directory");
  const auto folder = ProgramText::read(TWIN_SOURCE_DIR);
  ASSERT_FALSE(folder);
  EXPECT_EQ(folder.error().message, "is a directory; expected an NC program");
}

}  // namespace program_text_test
}  // namespace twin::gcode
