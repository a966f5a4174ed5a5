// A machine of one's own: two drives that follow their speed command with a first-order lag.
#include <array>
#include <cmath>
#include <cstdio>
#include <twin/machine.hpp>
#include <twin/run.hpp>

class FirstOrderDrives final : public twin::Machine {
 public:
  FirstOrderDrives() {
    info_.name = "first order";
    info_.mm_per_count = {0.001, 0.001};
    info_.mm_per_s_per_volt = {50.0, 50.0};
  }
  const twin::MachineInfo& info() const noexcept override { return info_; }
  std::optional<twin::Error> configure(double period) override {
    period_ = period;
    return std::nullopt;
  }
  std::optional<twin::Error> activate() override {
    position_ = velocity_ = {};
    return std::nullopt;
  }
  twin::MachineStatus read(twin::Inputs& inputs) noexcept override {
    const double decay = std::exp(-period_ / kLag);
    for (std::size_t i = 0; i < twin::kServoAxes; ++i) {
      const double wanted = info_.mm_per_s_per_volt[i] * outputs_.volts[i];  // [mm/s]
      position_[i] += wanted * period_ + (velocity_[i] - wanted) * kLag * (1.0 - decay);
      velocity_[i] = wanted + (velocity_[i] - wanted) * decay;
      inputs.counts[i] = std::llround(position_[i] / info_.mm_per_count[i]);
      inputs.servo_ready[i] = outputs_.servo_on[i];
    }
    return twin::MachineStatus::kOk;
  }
  twin::MachineStatus write(const twin::Outputs& outputs) noexcept override {
    outputs_ = outputs;
    return twin::MachineStatus::kOk;
  }
  twin::Truth truth() const noexcept override { return {position_}; }
  void deactivate() noexcept override { outputs_ = {}; }
  void cleanup() noexcept override { deactivate(); }
  std::string last_error() const override { return {}; }

 private:
  static constexpr double kLag = 0.005;  // time constant of the speed loop [s]
  twin::MachineInfo info_;
  twin::Outputs outputs_;
  std::array<double, twin::kServoAxes> position_{};  // [mm]
  std::array<double, twin::kServoAxes> velocity_{};  // [mm/s]
  double period_ = 0.001;                            // [s]
};

int main() {
  FirstOrderDrives drives;
  const twin::Run run = twin::run(twin::Program::from_file("square.nc"), twin::Settings(), drives);
  std::printf("%s\n", run.failure ? to_string(*run.failure).c_str() : "reached the end");
  std::printf("machine \"%s\": tracking error of x %.1f um\n", run.summary.text("hal").c_str(),
              run.summary.number("tracking_error_um.x.max"));
}
