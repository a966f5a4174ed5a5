#include <pybind11/stl.h>

#include <atomic>

#include "python/attended.hpp"
#include "python/bindings.hpp"

namespace twin::python {
namespace py = pybind11;

void bind_studies(py::module_& module) {
  module.def(
      "circle",
      [](const Settings& settings, double radius, double feedrate, std::string folder) {
        std::atomic<bool> stop{false};
        const CircleOptions options{radius, feedrate, std::move(folder), &stop};
        const Circle found =
            attended([&] { stop = true; }, [&] { return circle(settings, options); });
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
}

}  // namespace twin::python
