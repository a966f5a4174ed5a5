#include "hal/rig/io_port/find_card.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/hal/rig/as_nobody.hpp"
#include "tests/support/sysfs_tree.hpp"

namespace twin::hal::rig::io_port {
namespace find_card_test {

using test::AsNobody;
using test::SysfsTree;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kA = "0000:03:00.0";
constexpr const char* kB = "0000:04:00.0";

std::string refusal(const SysfsTree& tree, int board_id, const CardKind& kind = kPci1716) {
  const auto card = find_card(kind, board_id, Access::kSysfs, tree.root());
  EXPECT_FALSE(card);
  if (card) {
    return {};
  }
  EXPECT_EQ(card.error().code, ErrorCode::kMachine);
  EXPECT_THAT(card.error().message, Not(HasSubstr("\n")));
  return card.error().message;
}

TEST(FindCard, TakesTheOneWithTheBoardId) {
  SysfsTree tree;
  tree.add(kA, 0x1716, 0);
  tree.add(kB, 0x1716, 3, 0xD000);
  tree.add("0000:05:00.0", 0x1784, 3, 0xC000);
  const auto card = find_card(kPci1716, 3, Access::kSysfs, tree.root());
  ASSERT_TRUE(card) << card.error().message;
  EXPECT_EQ(card->pci.address, kB);
  EXPECT_EQ(card->port.path, tree.root() + "/bus/pci/devices/" + kB + "/resource2");
  const auto other = find_card(kPci1784, 3, Access::kSysfs, tree.root());
  ASSERT_TRUE(other) << other.error().message;
  EXPECT_EQ(other->pci.address, "0000:05:00.0");
}

TEST(FindCard, NamesWhatWasLookedForAndWhatIsThere) {
  SysfsTree tree;
  tree.add(kA, 0x1716, 0);
  tree.add(kB, 0x1716, 1);
  EXPECT_EQ(refusal(tree, 7), "no usable PCI-1716 (13fe:1716) with board ID 7 under " +
                                  tree.root() +
                                  "/bus/pci/devices; there is 0000:03:00.0 with board ID 0, "
                                  "0000:04:00.0 with board ID 1");
  EXPECT_EQ(refusal(tree, 7, kPci1784), "no usable PCI-1784 (13fe:1784) with board ID 7 under " +
                                            tree.root() +
                                            "/bus/pci/devices; there is no PCI-1784 at all");
}

TEST(FindCard, SaysWhenThereIsNoPciFolder) {
  const auto card = find_card(kPci1716, 0, Access::kSysfs, "/no/such/sys");
  ASSERT_FALSE(card);
  EXPECT_EQ(card.error().message,
            "no usable PCI-1716 (13fe:1716) with board ID 0 under /no/such/sys/bus/pci/devices, "
            "which is no folder");
}

TEST(FindCard, DoesNotTouchACardThatAKernelDriverHas) {
  SysfsTree tree;
  tree.add(kA, 0x1716, 0);
  tree.bind(kA, "adv_pci1710");
  tree.put(kA, "enable", "0\n");
  const std::string text = refusal(tree, 0);
  EXPECT_THAT(text, HasSubstr("kernel driver adv_pci1710 has it; unbind it: echo 0000:03:00.0 > " +
                              tree.root() + "/bus/pci/devices/0000:03:00.0/driver/unbind"));
  EXPECT_EQ(tree.get(kA, "enable"), "0\n");
}

TEST(FindCard, SwitchesOnACardThatIsOff) {
  SysfsTree tree;
  tree.add(kA, 0x1784, 2);
  tree.put(kA, "enable", "0");
  ASSERT_TRUE(find_card(kPci1784, 2, Access::kSysfs, tree.root()));
  EXPECT_EQ(tree.get(kA, "enable"), "1");
}

TEST(FindCard, WritesNoRegister) {
  SysfsTree tree;
  tree.add(kA, 0x1716, 2);
  const std::string before = tree.get(kA, "resource2");
  ASSERT_TRUE(find_card(kPci1716, 2, Access::kSysfs, tree.root()));
  EXPECT_EQ(tree.get(kA, "resource2"), before);
}

TEST(FindCard, RefusesTwoWithTheSameBoardId) {
  SysfsTree tree;
  tree.add(kA, 0x1716, 5);
  tree.add(kB, 0x1716, 5);
  EXPECT_EQ(
      refusal(tree, 5),
      "two PCI-1716 have board ID 5, 0000:03:00.0 and 0000:04:00.0: set their switches apart");
}

TEST(FindCard, SaysThatACardDoesNotAnswer) {
  SysfsTree tree;
  tree.add(kA, 0x1784, 0);
  tree.put(kA, "resource2", std::string(64, '\xFF'));
  EXPECT_THAT(refusal(tree, 15, kPci1784), HasSubstr("it does not answer"));
  tree.put(kA, "resource2", "short");
  EXPECT_THAT(refusal(tree, 0, kPci1784), HasSubstr("it does not answer"));
}

TEST(FindCard, RefusesTheVariantWithoutAnalogueOutputs) {
  SysfsTree tree;
  tree.add(kA, 0x1716, 0);
  tree.put(kA, "subsystem_device", "0x0001\n");
  EXPECT_THAT(refusal(tree, 0), HasSubstr("PCI-1716L"));
}

TEST(FindCard, RefusesBrokenResourceFiles) {
  SysfsTree tree;
  tree.add(kA, 0x1716, 0);
  tree.put(kA, "resource", "0x0 0x0 0x0\n");
  EXPECT_THAT(refusal(tree, 0), HasSubstr("resource has no line 3 for BAR 2"));
  for (const char* line : {"garbage", "0xe800 0xe83f", "0xe800 0xe83f 0x101zz",
                           "0xfffffffffffffffff 0x1 0x101", "e800 e83f 101"}) {
    tree.put(kA, "resource", std::string("0x0 0x0 0x0\n0x0 0x0 0x0\n") + line + "\n");
    EXPECT_THAT(refusal(tree, 0), HasSubstr("not three numbers in hexadecimal")) << line;
  }
  for (const char* line : {"0xe800 0xe83f 0x40200", "0x0 0x0 0x101", "0xe800 0xe000 0x101",
                           "0xfebff000 0xfebff0ff 0x101"}) {
    tree.put(kA, "resource", std::string("0x0 0x0 0x0\n0x0 0x0 0x0\n") + line + "\n");
    EXPECT_THAT(refusal(tree, 0), HasSubstr("is no range of I/O ports")) << line;
  }
  std::filesystem::remove(tree.folder().path() / SysfsTree::inside(kA, "resource"));
  EXPECT_THAT(refusal(tree, 0), HasSubstr("resource has no line 3"));
}

TEST(FindCard, PassesOverWhatHasNoIds) {
  SysfsTree tree;
  tree.put("0000:00:00.0", "vendor", "garbage\n");
  tree.put("0000:00:01.0", "vendor", "0x13fe");
  tree.put("0000:00:02.0", "vendor", "");
  tree.put("0000:00:03.0", "vendor", "0x13fe13fe13fe13fe13fe\n");
  tree.add(kA, 0x1716, 0);
  EXPECT_TRUE(find_card(kPci1716, 0, Access::kSysfs, tree.root()));
}

TEST(FindCard, MissingPermissionSaysWhatToDo) {
  SysfsTree tree;
  tree.add(kA, 0x1716, 0);
  const auto forbid = [&](const char* file, std::filesystem::perms left) {
    std::filesystem::permissions(tree.folder().path() / SysfsTree::inside(kA, file), left);
  };
  forbid("resource2", std::filesystem::perms(0444));
  {
    const AsNobody nobody;
    EXPECT_THAT(refusal(tree, 0), HasSubstr("no permission to open"));
  }
  tree.put(kA, "enable", "0\n");
  forbid("enable", std::filesystem::perms(0444));
  const AsNobody nobody;
  EXPECT_THAT(refusal(tree, 0), HasSubstr("switched off"));
  EXPECT_THAT(refusal(tree, 0), HasSubstr("run as root"));
}

TEST(IoBase, IsTheStartOfTheBar) {
  SysfsTree tree;
  tree.add(kA, 0x1716, 0, 0xDC40);
  const auto devices = pci_devices(tree.root(), 0x13FE, 0x1716);
  ASSERT_EQ(devices.size(), 1u);
  EXPECT_EQ(io_base(devices[0], 2).value_or(0), 0xDC40u);
  EXPECT_EQ(io_base(devices[0], 1).value_or(0), 0xE400u);
}

}  // namespace find_card_test
}  // namespace twin::hal::rig::io_port
