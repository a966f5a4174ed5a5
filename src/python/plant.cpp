#include <pybind11/stl.h>

#include "python/bindings.hpp"

namespace twin::python {
namespace py = pybind11;
namespace {

constexpr double kMillisecond = 1e-3;  // [s]

/// A machine that Python steps: drive commands in, counts out, one period at a time.
class Plant {
 public:
  Plant(const Settings& settings, const std::string& hal, const std::vector<std::string>& faults)
      : machine_(make_machine(hal, settings, faults)),
        period_(settings.number("interpolator.period_ms") * kMillisecond) {
    check(machine_->configure(period_));
    check(machine_->activate());
    outputs_.servo_on.fill(true);
  }
  Plant(const Plant&) = delete;
  Plant& operator=(const Plant&) = delete;
  ~Plant() { close(); }

  void command(const std::array<double, kServoAxes>& volts,
               const std::optional<std::array<double, 3>>& reference) {
    outputs_.volts = volts;
    if (reference) {
      outputs_.position_reference = *reference;
    }
    check(machine_->write(outputs_));
  }

  void advance() { check(machine_->read(inputs_)); }

  void close() noexcept {
    machine_->deactivate();
    machine_->cleanup();
  }

  const Inputs& inputs() const noexcept { return inputs_; }
  const MachineInfo& info() const noexcept { return machine_->info(); }
  double period() const noexcept { return period_; }
  std::array<double, kServoAxes> position() const noexcept {
    std::array<double, kServoAxes> position{};
    for (std::size_t i = 0; i < kServoAxes; ++i) {
      position[i] = static_cast<double>(inputs_.counts[i]) * info().mm_per_count[i];
    }
    return position;
  }
  std::array<double, kServoAxes> truth() const noexcept { return machine_->truth().table_position; }

 private:
  static void check(const std::optional<Error>& error) {
    if (error) {
      throw Failure(*error);
    }
  }
  void check(MachineStatus status) const {
    if (status != MachineStatus::kOk) {
      throw Failure({ErrorCode::kMachine, machine_->last_error(), {}, 0, 0});
    }
  }

  std::unique_ptr<Machine> machine_;
  double period_;  // [s]
  Outputs outputs_;
  Inputs inputs_;
};

}  // namespace

void bind_plant(py::module_& module) {
  using release = py::call_guard<py::gil_scoped_release>;
  py::class_<Plant>(module, "Plant")
      .def(py::init<const Settings&, const std::string&, const std::vector<std::string>&>(),
           py::arg("settings"), py::arg("hal") = "mujoco",
           py::arg("faults") = std::vector<std::string>(), release())
      .def("command", &Plant::command, py::arg("volts"), py::arg("reference_mm") = py::none())
      .def("advance", &Plant::advance, release())
      .def("close", &Plant::close)
      .def_property_readonly("period_s", &Plant::period)
      .def_property_readonly("counts", [](const Plant& p) { return p.inputs().counts; })
      .def_property_readonly("position_mm", [](const Plant& p) { return tuple_of(p.position()); })
      .def_property_readonly("truth_mm", [](const Plant& p) { return tuple_of(p.truth()); })
      .def_property_readonly("servo_ready", [](const Plant& p) { return p.inputs().servo_ready; })
      .def_property_readonly("alarm", [](const Plant& p) { return p.inputs().alarm; })
      .def_property_readonly("limit_positive",
                             [](const Plant& p) { return p.inputs().limit_positive; })
      .def_property_readonly("limit_negative",
                             [](const Plant& p) { return p.inputs().limit_negative; })
      .def_property_readonly("mm_per_count", [](const Plant& p) { return p.info().mm_per_count; })
      .def_property_readonly("mm_per_s_per_V",
                             [](const Plant& p) { return p.info().mm_per_s_per_volt; });
}

}  // namespace twin::python
