#include "hal/rig/assemble/make_rig.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "hal/rig/assemble/rig_ports.hpp"
#include "tests/support/table_files.hpp"

namespace twin::hal::rig::assemble {
namespace make_rig_test {

using ::testing::HasSubstr;

RigSetup setup_without_cards() {
  RigSetup setup;
  setup.table = test::default_table();
  setup.wiring.sysfs = "/no/such/sys";
  setup.shared_name = "/twin-no-such-rig";
  return setup;
}

TEST(FindRig, EmulatedBoardsAreThereWithoutALook) {
  const RigSetup setup = setup_without_cards();
  EXPECT_EQ(find_rig("emulated", setup.wiring, setup.shared_name), RigKind::kEmulated);
  EXPECT_EQ(find_rig("process", setup.wiring, setup.shared_name), RigKind::kProcess);
}

TEST(FindRig, AutoNamesAllThatItLookedFor) {
  const RigSetup setup = setup_without_cards();
  const auto kind = find_rig("auto", setup.wiring, setup.shared_name);
  ASSERT_FALSE(kind);
  EXPECT_THAT(kind.error().message, HasSubstr("PCI-1716"));
  EXPECT_THAT(kind.error().message,
              HasSubstr("; nor does an emulator run (twin rig emulate, /twin-no-such-rig)"));
}

TEST(MakeRig, EmulatedRigRunsAndTellsItsEnd) {
  std::string report;
  RigSetup setup = setup_without_cards();
  setup.at_end = [&report](emulator::EmulatedRig& rig) { report = rig.report(); };
  {
    auto rig = make_rig(RigKind::kEmulated, setup);
    ASSERT_TRUE(rig) << rig.error().message;
    EXPECT_TRUE((*rig)->info().simulated);
    ASSERT_TRUE(checked((*rig)->configure(1e-3)));
    ASSERT_TRUE(checked((*rig)->activate()));
  }
  EXPECT_THAT(report, HasSubstr("DAC 0 0x8000, DAC 1 0x8000"));
}

TEST(MakeRig, AnEmulatorThatDoesNotRunIsRefused) {
  EXPECT_FALSE(make_rig(RigKind::kProcess, setup_without_cards()));
}

TEST(MakeRig, ScalesAreThoseOfTheTableWhereTheWiringHasNone) {
  RigSetup setup = setup_without_cards();
  setup.wiring.axis[kY].mm_per_count = 0.5;
  const MachineInfo info = rig_info(setup.wiring, setup.table);
  EXPECT_EQ(info.mm_per_count[kX], setup.table.axis[kX].encoder.mm_per_count);
  EXPECT_EQ(info.mm_per_count[kY], 0.5);
}

TEST(Look, EmulatedBoardsReadVrefBack) {
  const RigSetup setup = setup_without_cards();
  EXPECT_EQ(wiring_to_look_with(RigKind::kEmulated, setup.wiring).axis[kY].vref_readback, 1);
  EXPECT_EQ(wiring_to_look_with(RigKind::kCards, setup.wiring).axis[kY].vref_readback, -1);
  const auto ports = open_to_look(RigKind::kEmulated, setup, 1e-3);
  ASSERT_TRUE(ports) << ports.error().message;
  EXPECT_EQ(ports->pci1716->error(), 0);
  EXPECT_FALSE(open_to_look(RigKind::kCards, setup, 1e-3));
}

}  // namespace make_rig_test
}  // namespace twin::hal::rig::assemble
