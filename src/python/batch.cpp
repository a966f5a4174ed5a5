#include <dlfcn.h>
#include <pybind11/stl.h>

#include "python/attended.hpp"
#include "python/bindings.hpp"

namespace twin::python {
namespace py = pybind11;
namespace {

/// File of the library that this module is linked with.
std::string library_file() {
  Dl_info info{};
  const int is_found = dladdr(reinterpret_cast<const void*>(&sweep_jobs), &info);
  return is_found != 0 && info.dli_fname != nullptr ? info.dli_fname : "";
}

}  // namespace

void bind_batch(py::module_& module) {
  module.attr("version") = TWIN_VERSION;
  module.def("library_file", &library_file);
  module.def("sweep_jobs", &sweep_jobs, py::arg("sweep_file"));
  module.def("job_key", &job_key, py::arg("job"));
  module.def("write_sweep", &write_sweep, py::arg("sweep_file"), py::arg("store"),
             py::arg("folder"));
  py::class_<JobResult>(module, "JobResult")
      .def_readonly("key", &JobResult::key)
      .def_readonly("was_found", &JobResult::was_found)
      .def_readonly("summary", &JobResult::summary)
      .def_readonly("failure", &JobResult::failure);
  module.def(
      "run_job",
      [](const std::string& job, const std::string& store) {
        return stoppable([&](auto* stop) { return run_job(job, store, stop); });
      },
      py::arg("job"), py::arg("store"));
}

}  // namespace twin::python
