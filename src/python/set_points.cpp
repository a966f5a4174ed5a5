#include "python/bindings.hpp"

namespace twin::python {
namespace py = pybind11;

void bind_set_points(py::module_& module) {
  py::class_<SetPoint>(module, "SetPoint")
      .def_readonly("time_s", &SetPoint::time)
      .def_property_readonly("position_mm", [](const SetPoint& p) { return tuple_of(p.position); })
      .def_property_readonly("velocity_mm_per_s",
                             [](const SetPoint& p) { return tuple_of(p.velocity); })
      .def_property_readonly("acceleration_mm_per_s2",
                             [](const SetPoint& p) { return tuple_of(p.acceleration); })
      .def_readonly("feedrate_mm_per_s", &SetPoint::feedrate)
      .def_readonly("segment", &SetPoint::segment)
      .def_readonly("line", &SetPoint::line);
  py::class_<Interpolator>(module, "SetPoints")
      .def(py::init<const Program&, const Settings&>(), py::arg("program"), py::arg("settings"))
      .def("__iter__", [](py::object self) { return self; })
      .def("__next__",
           [](Interpolator& points) {
             std::optional<SetPoint> point;
             {
               const py::gil_scoped_release released;
               point = points.next();
             }
             if (!point) {
               throw py::stop_iteration();
             }
             return *point;
           })
      .def_property_readonly("period_s", &Interpolator::period)
      .def("set_override", &Interpolator::set_override, py::arg("percent"))
      .def("hold", &Interpolator::hold)
      .def("resume", &Interpolator::resume);
}

}  // namespace twin::python
