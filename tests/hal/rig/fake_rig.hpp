#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "fake_port.hpp"
#include "hal/rig/register_cards.hpp"
#include "hal/rig/rig_machine.hpp"

namespace twin::test {

/// A port that hands everything to another, which outlives it.
class BorrowedPort final : public hal::rig::io_port::IoPort {
 public:
  explicit BorrowedPort(hal::rig::io_port::IoPort& port) : port_(port) {}
  std::uint8_t read8(std::uint32_t o) noexcept override { return port_.read8(o); }
  std::uint16_t read16(std::uint32_t o) noexcept override { return port_.read16(o); }
  std::uint32_t read32(std::uint32_t o) noexcept override { return port_.read32(o); }
  void write8(std::uint32_t o, std::uint8_t v) noexcept override { port_.write8(o, v); }
  void write16(std::uint32_t o, std::uint16_t v) noexcept override { port_.write16(o, v); }
  void write32(std::uint32_t o, std::uint32_t v) noexcept override { port_.write32(o, v); }
  int error() const noexcept override { return port_.error(); }

 private:
  hal::rig::io_port::IoPort& port_;
};

struct FakeBench final : hal::rig::Bench {
  int advances = 0;
  bool is_broken = false;
  double period = 0.0;
  double pen = 0.0;
  hal::Truth at;

  Expected<void> power_on(double p) override {
    period = p;
    return is_broken ? Expected<void>(fail(ErrorCode::kModel, "no model")) : Expected<void>();
  }
  bool advance() noexcept override {
    ++advances;
    return !is_broken;
  }
  hal::Truth truth() const noexcept override { return at; }
  void set_pen_reference(double z) noexcept override { pen = z; }
  std::string last_error() const override { return "the bench broke"; }
};

struct FakeWatch final : hal::rig::Watch {
  int arms = 0;
  int beats = 0;
  int disarms = 0;
  int acts_at_beat = -1;
  bool acted = false;
  bool alive = true;

  void arm() noexcept override { ++arms; }
  void beat() noexcept override {
    ++beats;
    acted = acted || beats == acts_at_beat;
  }
  void disarm() noexcept override { ++disarms; }
  bool has_acted() const noexcept override { return acted; }
  bool is_alive() noexcept override { return alive; }
};

/// A rig whose cards are recording ports: what reaches the registers is seen.
class FakeRig : public ::testing::Test {
 protected:
  static constexpr std::uint32_t kDac0 = 0x0A, kDac1 = 0x0C, kDigital = 0x10;
  static constexpr std::uint16_t kHealthy = 0b1101'1101;  // no alarm, not ready, no limit
  static constexpr double kPeriod = 1e-3;

  FakeRig() { pci1716.answers[kDigital] = kHealthy; }

  std::unique_ptr<hal::rig::RigMachine> make(bool with_bench = true) {
    const hal::rig::TableScales table{{0.005, -0.002}, {80.0, 90.0}};
    return std::make_unique<hal::rig::RigMachine>(
        settings, table,
        [this] {
          return hal::rig::RegisterCards::open(std::make_unique<BorrowedPort>(pci1716),
                                               std::make_unique<BorrowedPort>(pci1784), settings);
        },
        with_bench ? bench : nullptr, &watch);
  }
  /// Active, with volts at the drives and the servos on.
  std::unique_ptr<hal::rig::RigMachine> running(bool with_bench = true) {
    auto machine = make(with_bench);
    EXPECT_TRUE(checked(machine->configure(kPeriod)));
    const auto active = checked(machine->activate());
    EXPECT_TRUE(active) << active.error().message;
    hal::Outputs outputs;
    outputs.volts = {1.0, -2.0};
    outputs.servo_on = {true, true};
    EXPECT_EQ(machine->write(outputs), hal::Status::kOk);
    EXPECT_FALSE(is_safe());
    return machine;
  }
  bool is_safe() const {
    return pci1716.last(kDac0) == 0x8000 && pci1716.last(kDac1) == 0x8000 &&
           pci1716.last(kDigital) == 0;
  }

  FakePort pci1716, pci1784;
  std::shared_ptr<FakeBench> bench = std::make_shared<FakeBench>();
  FakeWatch watch;
  hal::rig::RigSettings settings;
  hal::Inputs inputs;
};

}  // namespace twin::test
