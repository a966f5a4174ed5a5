#include <pybind11/stl.h>

#include "python/bindings.hpp"

namespace twin::python {
namespace py = pybind11;

void bind_settings(py::module_& module) {
  py::class_<Settings>(module, "Settings")
      .def(py::init<const std::string&>(), py::arg("name") = "xy_table.toml")
      .def(py::init<const Settings&>())
      .def("set", py::overload_cast<const std::string&>(&Settings::set), py::arg("assignment"),
           py::return_value_policy::reference_internal)
      .def("number", &Settings::number, py::arg("key"))
      .def("text", &Settings::text, py::arg("key"))
      .def("keys", &Settings::keys)
      .def("toml", &Settings::toml)
      .def("notes", &Settings::notes)
      .def_property_readonly("name", &Settings::name);
}

}  // namespace twin::python
