#include "hal/rig/cards.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hal/rig/register_cards.hpp"
#include "tests/support/sysfs_tree.hpp"

namespace twin::hal::rig {
namespace cards_test {

using test::SysfsTree;
using ::testing::HasSubstr;

constexpr const char* kAnalogue = "0000:03:00.0";
constexpr const char* kCounter = "0000:03:01.0";

int word(const std::string& registers, std::size_t offset) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(registers.at(i)); };
  return byte(offset) | byte(offset + 1) << 8;
}

// The whole way from the settings to the registers of cards that are plain files.
TEST(OpenCards, FindsOpensWritesAndEndsSafe) {
  SysfsTree tree;
  tree.add(kAnalogue, 0x1716, 4);
  tree.add(kCounter, 0x1784, 9);
  RigSettings settings;
  settings.sysfs = tree.root();
  settings.pci1716_board_id = 4;
  settings.pci1784_board_id = 9;
  {
    const auto cards = open_cards(settings);
    ASSERT_TRUE(cards) << cards.error().message;
    EXPECT_EQ(word(tree.get(kAnalogue, "resource2"), 0x0A), 0x8000);
    EXPECT_EQ(word(tree.get(kAnalogue, "resource2"), 0x0E), 0x0101);
    CardOutputs outputs;
    outputs.volts = {5.0, -5.0};
    outputs.digital = 0x0005;
    ASSERT_EQ((*cards)->write(outputs), Status::kOk);
    EXPECT_EQ(word(tree.get(kAnalogue, "resource2"), 0x0A), 0xC000);
    EXPECT_EQ(word(tree.get(kAnalogue, "resource2"), 0x0C), 0x4000);
    CardInputs inputs;
    ASSERT_EQ((*cards)->read(inputs), Status::kOk);
    EXPECT_EQ(inputs.digital, 0x0005) << "in a file the inputs are the outputs";
  }
  EXPECT_EQ(word(tree.get(kAnalogue, "resource2"), 0x0A), 0x8000);
  EXPECT_EQ(word(tree.get(kAnalogue, "resource2"), 0x0C), 0x8000);
  EXPECT_EQ(word(tree.get(kAnalogue, "resource2"), 0x10), 0);
}

TEST(OpenCards, NamesTheCardThatIsMissingAndTouchesNoOther) {
  SysfsTree tree;
  tree.add(kAnalogue, 0x1716, 0);
  const std::string before = tree.get(kAnalogue, "resource2");
  RigSettings settings;
  settings.sysfs = tree.root();
  const auto cards = open_cards(settings);
  ASSERT_FALSE(cards);
  EXPECT_THAT(cards.error().message, HasSubstr("no usable PCI-1784 (13fe:1784) with board ID 0"));
  EXPECT_EQ(tree.get(kAnalogue, "resource2"), before);
}

TEST(OpenCards, CardsThatCannotBeReadToTheEndAreRefused) {
  SysfsTree tree;
  tree.add(kAnalogue, 0x1716, 0);
  tree.add(kCounter, 0x1784, 0);
  RigSettings settings;
  settings.sysfs = tree.root();
  tree.put(kCounter, "resource2", std::string(0x2C, '\0'));
  settings.reset_counters = true;
  EXPECT_TRUE(open_cards(settings)) << "a file grows where it is written";
  tree.put(kCounter, "resource2", std::string(0x29, '\0'));
  const auto cards = open_cards(settings);
  ASSERT_FALSE(cards);
  EXPECT_THAT(cards.error().message, HasSubstr("does not answer"));
}

}  // namespace cards_test
}  // namespace twin::hal::rig
