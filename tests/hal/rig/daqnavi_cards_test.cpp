#include "hal/rig/daqnavi_cards.hpp"

#include <dlfcn.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "hal/rig/cards.hpp"
#include "tests/hal/rig/stand_in/stand_in.hpp"
#include "tests/support/allocations.hpp"

namespace twin::hal::rig {
namespace daqnavi_cards_test {

using ::testing::AnyOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class Daqnavi : public ::testing::Test {
 protected:
  void SetUp() override {
    library = ::dlopen(STAND_IN_LIBRARY, RTLD_NOW | RTLD_LOCAL);
    ASSERT_NE(library, nullptr) << ::dlerror();
    card = reinterpret_cast<StandInState>(::dlsym(library, "stand_in"))();
    *card = StandIn{};
    settings.driver = Driver::kDaqnavi;
    settings.daqnavi_library = STAND_IN_LIBRARY;
    settings.axis[kX].servo_on.when = Level::kLow;
  }
  void TearDown() override {
    EXPECT_EQ(card->objects, 0) << "all objects are disposed of";
    ::dlclose(library);
  }
  std::unique_ptr<Cards> open() {
    auto cards = open_cards(settings);
    EXPECT_TRUE(cards) << cards.error().message;
    return cards ? std::move(*cards) : nullptr;
  }
  bool is_safe() const {
    return card->volts[0] == 0.0 && card->volts[1] == 0.0 && card->digital_out[0] == 1 &&
           card->digital_out[1] == 0;
  }

  void* library = nullptr;
  StandIn* card = nullptr;
  RigSettings settings;
};

TEST_F(Daqnavi, OpensBothCardsWithDrivesOffFirstAndZeroVolts) {
  settings.pci1716_board_id = 3;
  settings.pci1784_board_id = 12;
  settings.axis[kY].counter = 3;
  const auto cards = open();
  ASSERT_NE(cards, nullptr);
  EXPECT_TRUE(is_safe());
  EXPECT_THAT(card->range, ElementsAre(1, 1));
  EXPECT_EQ(card->description, "PCI-1784,BID#12");
  EXPECT_EQ(card->mode, 3) << "no reset of the card";
  EXPECT_THAT(card->counting_type, ElementsAre(7, 0, 0, 7));
  EXPECT_THAT(card->is_counting, ElementsAre(true, false, false, true));
  const auto place = [&](const char* name) {
    return std::find(card->calls.begin(), card->calls.end(), name) - card->calls.begin();
  };
  EXPECT_LT(place("InstantDoCtrl_WriteAny"), place("InstantAoCtrl_setSelectedDevice"));
  EXPECT_LT(place("AnalogChannel_setValueRange"), place("InstantAoCtrl_WriteAny"));
}

TEST_F(Daqnavi, ReadsAndWrites) {
  const auto cards = open();
  ASSERT_NE(cards, nullptr);
  card->digital_in[0] = 0xC3;
  card->digital_in[1] = 0xA5;
  card->count[1] = -70;
  CardInputs inputs;
  ASSERT_EQ(cards->read(inputs), Status::kOk);
  EXPECT_EQ(inputs.digital, 0xA5C3);
  EXPECT_THAT(inputs.counts, ElementsAre(0, -70, 0, 0));
  CardOutputs outputs;
  outputs.volts = {1.25, std::numeric_limits<double>::quiet_NaN()};
  outputs.digital = 0x8003;
  card->calls.clear();
  ASSERT_EQ(cards->write(outputs), Status::kOk);
  EXPECT_THAT(card->volts, ElementsAre(1.25, 0.0));
  EXPECT_THAT(card->digital_out, ElementsAre(0x03, 0x80));
  EXPECT_THAT(card->calls, ElementsAre("InstantDoCtrl_WriteAny", "InstantAoCtrl_WriteAny"));
  outputs.volts = {1e6, -1e6};
  ASSERT_EQ(cards->write(outputs), Status::kOk);
  EXPECT_THAT(card->volts, ElementsAre(10.0 - 20.0 / 65536, -10.0));
  cards->make_safe();
  EXPECT_TRUE(is_safe());
}

TEST_F(Daqnavi, CountsGoOnAcrossTheEndsOf32Bits) {
  card->count[0] = std::numeric_limits<std::int32_t>::max() - 1;
  const auto cards = open();
  ASSERT_NE(cards, nullptr);
  CardInputs inputs;
  card->count[0] = std::numeric_limits<std::int32_t>::min() + 3;
  ASSERT_EQ(cards->read(inputs), Status::kOk);
  EXPECT_EQ(inputs.counts[0], 5);
}

TEST_F(Daqnavi, EndsSafeWhateverIsWritten) {
  {
    const auto cards = open();
    ASSERT_NE(cards, nullptr);
    CardOutputs outputs;
    outputs.volts = {5.0, -5.0};
    outputs.digital = 0xFFFF;
    ASSERT_EQ(cards->write(outputs), Status::kOk);
  }
  EXPECT_TRUE(is_safe());
}

TEST_F(Daqnavi, EachCallThatFailsWhileOpeningIsNamed) {
  for (const char* call :
       {"AdxInstantDoCtrlCreate", "AdxInstantAoCtrlCreate", "InstantDoCtrl_setSelectedDevice",
        "InstantDoCtrl_WriteAny", "InstantAoCtrl_setSelectedDevice", "InstantAoCtrl_getChannels",
        "ICollection_getItem", "AnalogChannel_setValueRange", "InstantAoCtrl_WriteAny",
        "AdxInstantDiCtrlCreate", "InstantDiCtrl_setSelectedDevice", "AdxUdCounterCtrlCreate",
        "UdCounterCtrl_setSelectedDevice", "UdCounterCtrl_setChannel",
        "UdCounterCtrl_setCountingType", "UdCounterCtrl_setEnabled"}) {
    *card = StandIn{};
    card->failing = call;
    const auto cards = open_cards(settings);
    ASSERT_FALSE(cards) << call;
    EXPECT_EQ(cards.error().code, ErrorCode::kMachine);
    EXPECT_THAT(cards.error().message,
                AnyOf(HasSubstr("PCI-1716,BID#0"), HasSubstr("PCI-1784,BID#0")));
    if (std::string(call).find("Create") == std::string::npos &&
        std::string(call).find("get") == std::string::npos) {
      EXPECT_THAT(cards.error().message, HasSubstr(call));
      EXPECT_THAT(cards.error().message, HasSubstr("0xe0000015"));
    }
    EXPECT_EQ(card->objects, 0) << call;
  }
}

TEST_F(Daqnavi, AWarningIsNoFailure) {
  card->failing = "AnalogChannel_setValueRange";
  card->code = 0xA0000001;
  EXPECT_NE(open(), nullptr);
}

TEST_F(Daqnavi, CallsThatFailInTheCycleAreErrorsWithTheirName) {
  const auto cards = open();
  ASSERT_NE(cards, nullptr);
  EXPECT_EQ(cards->last_error(), "");
  card->failing = "InstantDiCtrl_ReadAny";
  CardInputs inputs;
  EXPECT_EQ(cards->read(inputs), Status::kError);
  EXPECT_EQ(cards->last_error(),
            "the PCI-1716 no longer answers: DAQNavi's InstantDiCtrl_ReadAny failed with "
            "0xe0000015");
  for (const char* call : {"InstantDoCtrl_WriteAny", "InstantAoCtrl_WriteAny"}) {
    card->failing = call;
    EXPECT_EQ(cards->write({}), Status::kError);
    EXPECT_THAT(cards->last_error(), HasSubstr(call));
  }
}

TEST_F(Daqnavi, ReadAndWriteAllocateNothing) {
  const auto cards = open();
  ASSERT_NE(cards, nullptr);
  card->is_recording = false;
  CardInputs inputs;
  int failures = 0;
  const std::int64_t before = test::allocations();
  for (int k = 0; k < 100; ++k) {
    failures += cards->read(inputs) != Status::kOk;
    failures += cards->write({}) != Status::kOk;
  }
  EXPECT_EQ(test::allocations() - before, 0);
  EXPECT_EQ(failures, 0);
}

TEST_F(Daqnavi, AMissingLibraryOrFunctionIsNamedInOneLine) {
  settings.daqnavi_library = "libno_such_biodaq.so";
  auto cards = open_cards(settings);
  ASSERT_FALSE(cards);
  EXPECT_THAT(cards.error().message,
              HasSubstr("cannot load Advantech's DAQNavi library: libno_such_biodaq.so"));
  EXPECT_EQ(cards.error().message.find('\n'), std::string::npos);
  settings.daqnavi_library = STAND_IN_WITHOUT_COUNTER_VALUE;
  cards = open_cards(settings);
  ASSERT_FALSE(cards);
  EXPECT_THAT(cards.error().message, HasSubstr("has no function UdCounterCtrl_getValue"));
}

}  // namespace daqnavi_cards_test
}  // namespace twin::hal::rig
