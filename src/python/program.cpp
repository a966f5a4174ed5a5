#include <pybind11/stl.h>

#include "python/attended.hpp"
#include "python/bindings.hpp"

namespace twin::python {
namespace py = pybind11;
namespace {

py::dict figures_of(const ProgramFigures& figures) {
  py::dict result;
  result["blocks"] = figures.blocks;
  result["length_mm"] = figures.length;
  result["box_min_mm"] = tuple_of(figures.box_min);
  result["box_max_mm"] = tuple_of(figures.box_max);
  return result;
}

}  // namespace

void bind_program(py::module_& module) {
  py::class_<Program>(module, "Program")
      .def_static("from_file", &Program::from_file, py::arg("name"))
      .def_static("from_text", &Program::from_text, py::arg("text"), py::arg("name") = "program.nc")
      .def("with_feedrate", &Program::with_feedrate, py::arg("mm_per_s"))
      .def_property_readonly("name", &Program::name);

  py::class_<Plan>(module, "Plan")
      .def_property_readonly("time_s", &Plan::time)
      .def_property_readonly("path_length_mm", &Plan::path_length)
      .def_property_readonly("blocks", &Plan::blocks)
      .def_property_readonly("curves", &Plan::curves)
      .def_property_readonly("lines", &Plan::lines)
      .def_property_readonly("arcs", &Plan::arcs)
      .def_property_readonly("segments", &Plan::segments)
      .def_property_readonly("certified_deviation_mm", &Plan::certified_deviation)
      .def("bound_s", [](const Plan& plan) {
        return stoppable([&](auto* stop) { return plan.bound(stop); });
      });

  module.def(
      "check",
      [](const Program& program, const Settings& settings) {
        return figures_of(stoppable([&](auto* stop) { return program.check(settings, stop); }));
      },
      py::arg("program"), py::arg("settings"));
  module.def(
      "plan",
      [](const Program& program, const Settings& settings) {
        return stoppable([&](auto* stop) { return plan(program, settings, stop); });
      },
      py::arg("program"), py::arg("settings"));
}

}  // namespace twin::python
