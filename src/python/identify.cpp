#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include "python/attended.hpp"
#include "python/bindings.hpp"

namespace twin::python {
namespace py = pybind11;

void bind_identify(py::module_& module) {
  py::class_<Identification>(module, "Identification")
      .def_readonly("settings", &Identification::settings)
      .def_readonly("toml", &Identification::toml)
      .def_readonly("table", &Identification::table)
      .def_readonly("json", &Identification::json)
      .def_readonly("notes", &Identification::notes);
  module.def(
      "identify",
      [](const std::vector<std::string>& traces, const Settings& start, std::string columns,
         std::vector<std::string> fixed, std::vector<std::string> freed,
         std::vector<std::string> at_table, std::vector<std::string> validating,
         std::size_t evaluations, std::uint32_t seed) {
        IdentifyOptions options;
        options.columns = std::move(columns);
        options.fixed = std::move(fixed);
        options.freed = std::move(freed);
        options.at_table = std::move(at_table);
        options.validating = std::move(validating);
        options.evaluations = evaluations;
        options.seed = seed;
        return stoppable([&](auto* stop) {
          options.stop = stop;
          return twin::identify(traces, start, options);
        });
      },
      py::arg("traces"), py::arg("start"), py::kw_only(), py::arg("columns") = "",
      py::arg("fixed") = std::vector<std::string>(), py::arg("freed") = std::vector<std::string>(),
      py::arg("at_table") = std::vector<std::string>(),
      py::arg("validating") = std::vector<std::string>(), py::arg("evaluations") = 0,
      py::arg("seed") = 1);
}

}  // namespace twin::python
