#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include <atomic>

#include "python/attended.hpp"
#include "python/bindings.hpp"

namespace twin::python {
namespace py = pybind11;

py::object error_object(const Error& error);

std::unique_ptr<Machine> make_machine(const std::string& hal, const Settings& settings,
                                      const std::vector<std::string>& faults) {
  if (hal == "emulated_rig") {
    return make_emulated_rig(settings, faults);
  }
  if (!faults.empty()) {
    throw Failure({ErrorCode::kUsage, "faults need hal = \"emulated_rig\"", {}, 0, 0});
  }
  if (hal == "mujoco") {
    return make_table(settings);
  }
  if (hal == "ideal") {
    return make_ideal();
  }
  throw Failure({ErrorCode::kUsage,
                 "no machine is called \"" + hal + "\"; expected mujoco, ideal or emulated_rig",
                 {},
                 0,
                 0});
}

namespace {

/// What a run has left, for Python.
struct Outcome {
  std::string summary;                 // the text of summary.json
  std::string table;                   // what `twin run` prints
  std::shared_ptr<MemoryTrace> trace;  // null if none was kept
  std::optional<Error> failure;
  std::optional<ShadowReport> shadow;
};

/// Panel orders of Python go to a panel that outlives the run.
struct SharedPanel {
  Panel panel;
};

struct Request {
  std::string hal;
  std::vector<std::string> faults;
  std::vector<std::pair<double, double>> overrides;  // time [s], percent
  std::string folder;
  bool keeps_trace = true;
  bool is_wall_clock = false;
  std::string trace_files = "csv";
  std::string correction;
  std::string learning;
  std::optional<std::string> shadow;  // file of what was learnt, or empty; nothing: no shadow
};

Outcome run_program(const Program& program, const Settings& settings, const Request& request,
                    const std::shared_ptr<SharedPanel>& shared, Servo* servo) {
  const std::unique_ptr<Machine> machine = make_machine(request.hal, settings, request.faults);
  Outcome outcome;
  RunOptions options;
  if (request.keeps_trace) {
    outcome.trace = std::make_shared<MemoryTrace>();
    options.sinks = {outcome.trace.get()};
  }
  for (const auto& [time, percent] : request.overrides) {
    options.overrides.push_back({time, percent});
  }
  options.folder = request.folder;
  options.trace_files = request.trace_files;
  options.is_wall_clock = request.is_wall_clock;
  options.servo = servo;
  options.correction = request.correction;
  options.learning = request.learning;
  options.has_shadow = request.shadow.has_value();
  options.shadow_learnt = request.shadow.value_or("");
  std::atomic<bool> stop{false};
  options.stop = &stop;
  if (shared) {
    options.panel = &shared->panel;
  }
  const auto end = [&] {
    stop = true;
    if (shared) {
      shared->panel.stop();
    }
  };
  const Run run = attended(end, [&] { return twin::run(program, settings, *machine, options); });
  outcome.summary = run.summary.json();
  outcome.table = run.summary.table();
  outcome.failure = run.failure;
  outcome.shadow = run.shadow;
  return outcome;
}

/// A position loop that Python computes, in the motion's thread.
class PythonServo final : public Servo {
 public:
  explicit PythonServo(py::object function) : function_(std::move(function)) {}
  ~PythonServo() override {
    const py::gil_scoped_acquire acquired;
    function_ = py::object();
    raised_.reset();
  }

  std::optional<std::array<double, kServoAxes>> volts(
      const SetPoint& point, const std::array<double, kServoAxes>& measured) noexcept override {
    const py::gil_scoped_acquire acquired;
    try {
      const py::object volts = function_(point, tuple_of(measured));
      return volts.cast<std::array<double, kServoAxes>>();
    } catch (py::error_already_set& error) {
      raised_.emplace(std::move(error));
    } catch (const std::exception&) {
      PyErr_SetString(PyExc_TypeError, "the servo must return two numbers: volts of x and y");
      raised_.emplace();
    }
    return std::nullopt;
  }

  /// Throws what the function has raised, if it has.
  void rethrow() {
    if (raised_) {
      throw *std::exchange(raised_, std::nullopt);
    }
  }

 private:
  py::object function_;
  std::optional<py::error_already_set> raised_;
};

Outcome run(const Program& program, const Settings& settings, const Request& request,
            const std::shared_ptr<SharedPanel>& panel, const py::object& servo) {
  if (servo.is_none()) {
    return run_program(program, settings, request, panel, nullptr);
  }
  PythonServo loop(servo);
  const Outcome outcome = run_program(program, settings, request, panel, &loop);
  loop.rethrow();
  return outcome;
}

void bind_panel(py::module_& module) {
  const py::class_<SharedPanel, std::shared_ptr<SharedPanel>> panel(module, "Panel");
  py::class_<Panel::Display>(module, "Display")
      .def_property_readonly(
          "state",
          [](const Panel::Display& display) {
            constexpr const char* kNames[] = {"waiting", "moving", "holding", "starved", "ended"};
            return kNames[static_cast<std::size_t>(display.state)];
          })
      .def_readonly("time_s", &Panel::Display::time)
      .def_readonly("percent", &Panel::Display::percent)
      .def_readonly("feedrate_mm_per_s", &Panel::Display::feedrate)
      .def_readonly("line", &Panel::Display::line);
  auto shared = panel;
  shared.def(py::init<>())
      .def(
          "set_override",
          [](SharedPanel& self, double percent) { self.panel.set_override(percent); },
          py::arg("percent"))
      .def("hold", [](SharedPanel& self) { self.panel.hold(); })
      .def("resume", [](SharedPanel& self) { self.panel.resume(); })
      .def("stop", [](SharedPanel& self) { self.panel.stop(); })
      .def("display", [](const SharedPanel& self) { return self.panel.display(); });
}

}  // namespace

void bind_run(py::module_& module) {
  bind_panel(module);
  py::class_<Outcome>(module, "Outcome")
      .def_readonly("summary", &Outcome::summary)
      .def_readonly("table", &Outcome::table)
      .def_readonly("trace", &Outcome::trace)
      .def_readonly("shadow", &Outcome::shadow)
      .def_property_readonly("failure", [](const Outcome& outcome) {
        return outcome.failure ? error_object(*outcome.failure) : py::none();
      });
  module.def(
      "run",
      [](const Program& program, const Settings& settings, std::string hal,
         std::vector<std::string> faults, std::vector<std::pair<double, double>> overrides,
         std::string folder, bool keep_trace, bool wall_clock,
         const std::shared_ptr<SharedPanel>& panel, const py::object& servo,
         std::string trace_files, std::string correction, std::string learning,
         std::optional<std::string> shadow) {
        return run(program, settings,
                   {std::move(hal), std::move(faults), std::move(overrides), std::move(folder),
                    keep_trace, wall_clock, std::move(trace_files), std::move(correction),
                    std::move(learning), std::move(shadow)},
                   panel, servo);
      },
      py::arg("program"), py::arg("settings"), py::kw_only(), py::arg("hal") = "mujoco",
      py::arg("faults") = std::vector<std::string>(),
      py::arg("overrides") = std::vector<std::pair<double, double>>(), py::arg("folder") = "",
      py::arg("keep_trace") = true, py::arg("wall_clock") = false, py::arg("panel") = nullptr,
      py::arg("servo") = py::none(), py::arg("trace_files") = "csv", py::arg("correction") = "",
      py::arg("learning") = "", py::arg("shadow") = py::none());
}

}  // namespace twin::python
