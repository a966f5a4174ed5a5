#include "python/bindings.hpp"

PYBIND11_MODULE(_twin, module) {
  module.doc() = "The library twin::twin as Python sees it; use the package `twin` instead.";
  twin::python::bind_errors(module);
  twin::python::bind_settings(module);
  twin::python::bind_program(module);
  twin::python::bind_trace(module);
  twin::python::bind_run(module);
  twin::python::bind_identify(module);
  twin::python::bind_plant(module);
  twin::python::bind_studies(module);
  twin::python::bind_batch(module);
  twin::python::bind_set_points(module);
}
