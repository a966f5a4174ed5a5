#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cerrno>

#include "hal/rig/io_port/ioperm_port.hpp"
#include "hal/rig/io_port/port_address.hpp"
#include "hal/rig/io_port/sysfs_port.hpp"
#include "tests/hal/rig/as_nobody.hpp"
#include "tests/support/files.hpp"
#include "tests/support/temp_folder.hpp"

namespace twin::hal::rig::io_port {
namespace ports_test {

using test::AsNobody;
using test::TempFolder;
using ::testing::HasSubstr;

TEST(SysfsPort, AccessesAreAsWideAsCalledAndAtTheirOffset) {
  const TempFolder folder;
  const std::string file = folder.put("resource2", std::string(16, '\0'));
  const auto port = SysfsPort::open(file);
  ASSERT_TRUE(port);
  (*port)->write8(1, 0xAB);
  (*port)->write16(4, 0x1234);
  (*port)->write32(8, 0xDEADBEEF);
  const std::string bytes = test::content(folder / "resource2");
  const std::string expected("\0\xAB\0\0\x34\x12\0\0\xEF\xBE\xAD\xDE\0\0\0\0", 16);
  EXPECT_EQ(bytes, expected);
  EXPECT_EQ((*port)->read8(1), 0xAB);
  EXPECT_EQ((*port)->read16(4), 0x1234);
  EXPECT_EQ((*port)->read32(8), 0xDEADBEEF);
  EXPECT_EQ((*port)->error(), 0);
}

TEST(SysfsPort, AReadBeyondTheEndIsAllOnesAndStaysAnError) {
  const TempFolder folder;
  const auto port = SysfsPort::open(folder.put("resource2", "abc"));
  ASSERT_TRUE(port);
  EXPECT_EQ((*port)->read32(0), 0xFFFFFFFF) << "three of four bytes are none";
  EXPECT_EQ((*port)->error(), EIO);
  EXPECT_EQ((*port)->read8(0), 'a');
  EXPECT_EQ((*port)->error(), EIO) << "the first error stays";
  EXPECT_EQ((*port)->read16(100), 0xFFFF);
  EXPECT_EQ((*port)->read8(100), 0xFF);
}

TEST(SysfsPort, AFailedWriteIsAnErrorAndLeavesErrnoAlone) {
  const auto port = SysfsPort::open("/dev/full");
  ASSERT_TRUE(port);
  errno = 0;
  (*port)->write16(0, 1);
  EXPECT_EQ((*port)->error(), ENOSPC);
  EXPECT_EQ(errno, 0) << "a signal handler may have been here";
}

TEST(SysfsPort, AFileThatIsNotThereIsNamed) {
  const auto port = SysfsPort::open("/no/such/resource2");
  ASSERT_FALSE(port);
  EXPECT_EQ(port.error().code, ErrorCode::kMachine);
  EXPECT_EQ(port.error().message, "cannot open /no/such/resource2: No such file or directory");
}

TEST(SysfsPort, MissingPermissionSaysWhatToDo) {
  const TempFolder folder;
  const std::string file = folder.put("resource2", "abcd");
  std::filesystem::permissions(file, std::filesystem::perms::none);
  const AsNobody nobody;
  const auto port = SysfsPort::open(file);
  ASSERT_FALSE(port);
  EXPECT_THAT(port.error().message, HasSubstr("no permission to open " + file + ": run as root"));
}

TEST(IopermPort, RefusesWhatIsNoBaseOfACard) {
  for (const std::uint32_t base : {0u, 0xFFF0u, 0x10000u, 0xFFFFFFFFu}) {
    const auto port = IopermPort::open(base);
    ASSERT_FALSE(port) << base;
    EXPECT_EQ(port.error().code, ErrorCode::kMachine);
    EXPECT_EQ(port.error().message.find('\n'), std::string::npos);
  }
}

TEST(IopermPort, MissingPermissionSaysWhatToDo) {
  const AsNobody nobody;
  const auto port = IopermPort::open(0xE800);
  ASSERT_FALSE(port);
  EXPECT_THAT(port.error().message, HasSubstr("sysfs"));
}

TEST(PortAddress, IsTheSameAfterItsText) {
  for (const PortAddress& address :
       {PortAddress{Access::kSysfs, "/sys/bus/pci/devices/0000:03:00.0/resource2", 0},
        PortAddress{Access::kIoperm, "", 0xE800}}) {
    const auto again = port_address_from_text(to_text(address));
    ASSERT_TRUE(again) << to_text(address);
    EXPECT_EQ(*again, address);
  }
  EXPECT_EQ(to_text({Access::kIoperm, "", 0xE800}), "ioperm:0xe800");
  EXPECT_EQ(to_text({Access::kSysfs, "/a b", 0}), "sysfs:/a b");
}

TEST(PortAddress, RefusesOtherTexts) {
  for (const char* text :
       {"", "sysfs:", "ioperm:", "ioperm:0x", "ioperm:e800", "ioperm:0xzz", "ioperm:0xe800 ",
        "ioperm:0x10000", "/sys/resource2", "ioperm:0x-1", "ioperm:0x123456789abcdef01"}) {
    const auto address = port_address_from_text(text);
    ASSERT_FALSE(address) << text;
    EXPECT_EQ(address.error().code, ErrorCode::kUsage);
  }
}

TEST(PortAddress, OpensThePortItNames) {
  const TempFolder folder;
  const auto port =
      open_port({Access::kSysfs, folder.put("resource2", std::string("\x34\x12", 2)), 0});
  ASSERT_TRUE(port);
  EXPECT_EQ((*port)->read16(0), 0x1234);
  EXPECT_FALSE(open_port({Access::kSysfs, "/no/such/file", 0}));
  EXPECT_FALSE(open_port({Access::kIoperm, "", 0}));
}

}  // namespace ports_test
}  // namespace twin::hal::rig::io_port
