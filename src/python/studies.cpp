#include <pybind11/stl.h>

#include "python/attended.hpp"
#include "python/bindings.hpp"

namespace twin::python {
namespace py = pybind11;

namespace {

void bind_compensation(py::module_& module) {
  module.def(
      "compensate",
      [](const Program& program, const Settings& settings, const std::string& file) {
        const Compensation made = stoppable([&](auto* stop) {
          return compensate(program, settings, file, {stop, {}});
        });
        return py::make_tuple(made.max_before, made.max_after, made.rms_before, made.rms_after,
                              made.iterations);
      },
      py::arg("program"), py::arg("settings"), py::arg("file"));
}

void bind_shadow(py::module_& module) {
  py::class_<ShadowFinding>(module, "ShadowFinding")
      .def_readonly("axis", &ShadowFinding::axis)
      .def_readonly("cause", &ShadowFinding::cause)
      .def_readonly("change", &ShadowFinding::change)
      .def_readonly("deviation", &ShadowFinding::deviation)
      .def_readonly("since_s", &ShadowFinding::since)
      .def_readonly("found_s", &ShadowFinding::found)
      .def_readonly("or_else", &ShadowFinding::or_else)
      .def("__str__", [](const ShadowFinding& finding) { return finding.text; });
  py::class_<ShadowReport>(module, "ShadowReport")
      .def_readonly("trace", &ShadowReport::trace)
      .def_readonly("findings", &ShadowReport::findings)
      .def_readonly("switched_off", &ShadowReport::switched_off)
      .def_readonly("table", &ShadowReport::table)
      .def_readonly("json", &ShadowReport::json);
  module.def(
      "learn_shadow",
      [](const std::vector<std::string>& traces, const Settings& settings, const std::string& file,
         const std::string& columns) {
        return stoppable([&](const std::atomic<bool>* stop) {
          return learn_shadow(traces, settings, file, columns, stop);
        });
      },
      py::arg("traces"), py::arg("settings"), py::arg("file"), py::arg("columns"));
  module.def(
      "watch",
      [](const std::vector<std::string>& traces, const Settings& settings,
         const std::string& learnt, const std::string& columns) {
        return stoppable([&](const std::atomic<bool>* stop) {
          return watch(traces, settings, learnt, columns, stop);
        });
      },
      py::arg("traces"), py::arg("settings"), py::arg("learnt"), py::arg("columns"));
}

}  // namespace

void bind_studies(py::module_& module) {
  bind_compensation(module);
  bind_shadow(module);
  module.def(
      "circle",
      [](const Settings& settings, double radius, double feedrate, std::string folder) {
        const Circle found = stoppable([&](auto* stop) {
          return circle(settings, {radius, feedrate, std::move(folder), stop});
        });
        return py::make_tuple(found.table, found.json);
      },
      py::arg("settings"), py::arg("radius_mm"), py::arg("feedrate_mm_per_s"), py::arg("folder"));
  module.def(
      "convert",
      [](const Program& program, const Settings& settings, const std::string& dialect) {
        const Converted made = attended([] {}, [&] { return convert(program, settings, dialect); });
        return py::make_tuple(made.text, made.table);
      },
      py::arg("program"), py::arg("settings"), py::arg("dialect"));
  module.def(
      "write_report",
      [](const std::vector<std::string>& folders, const std::string& file,
         const std::vector<Program>& programs) {
        attended([] {},
                 [&] {
                   write_report(folders, file, programs);
                   return 0;
                 });
      },
      py::arg("folders"), py::arg("file"), py::arg("programs"));
  module.def(
      "tune",
      [](std::vector<std::string> programs, std::string machine,
         const std::optional<double>& feedrate, const std::optional<double>& within_um,
         double gain_margin_dB, double phase_margin_deg, std::vector<std::string> ranges,
         std::vector<std::string> further, std::size_t trials, std::uint32_t seed, unsigned workers,
         std::string store, std::string folder) {
        TuneOptions options{.programs = std::move(programs),
                            .machine = std::move(machine),
                            .feedrate = feedrate,
                            .is_for_time = within_um.has_value(),
                            .largest_error = within_um.value_or(0.0),
                            .gain_margin_dB = gain_margin_dB,
                            .phase_margin_deg = phase_margin_deg,
                            .ranges = std::move(ranges),
                            .further_programs = std::move(further),
                            .trials = trials,
                            .seed = seed,
                            .workers = workers,
                            .store = std::move(store),
                            .folder = std::move(folder)};
        const Tuned found = stoppable([&](auto* stop) {
          options.stop = stop;
          return tune(options);
        });
        return py::make_tuple(found.table, found.json, found.machine_file);
      },
      py::arg("programs"), py::arg("machine"), py::arg("feedrate_mm_per_s"), py::arg("within_um"),
      py::arg("gain_margin_dB"), py::arg("phase_margin_deg"), py::arg("ranges"), py::arg("further"),
      py::arg("trials"), py::arg("seed"), py::arg("workers"), py::arg("store"), py::arg("folder"));
}

}  // namespace twin::python
