#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include "python/bindings.hpp"

namespace twin::python {
namespace py = pybind11;
namespace {

/// A column as a read-only array that shares the trace's memory and keeps it alive.
py::array_t<double> column_of(const std::shared_ptr<MemoryTrace>& trace, const std::string& name) {
  if (!trace->has(name)) {
    throw py::key_error(name);
  }
  const std::span<const double> values = (*trace)[name];
  const py::capsule owner(new std::shared_ptr<MemoryTrace>(trace), [](void* kept) {
    delete static_cast<std::shared_ptr<MemoryTrace>*>(kept);
  });
  py::array_t<double> array(static_cast<py::ssize_t>(values.size()), values.data(), owner);
  array.attr("flags").attr("writeable") = false;
  return array;
}

void check(const std::optional<Error>& error) {
  if (error) {
    throw Failure(*error);
  }
}

/// Writes a trace as CsvTrace does while a run is under way.
void write_csv(const MemoryTrace& trace, const std::string& folder) {
  CsvTrace file(folder);
  const TraceHeader& header = trace.header();
  check(file.begin(header));
  std::vector<std::span<const double>> columns;
  for (const TraceColumn& column : header.columns) {
    columns.push_back(trace[column.name]);
  }
  std::vector<double> row(columns.size());
  for (std::size_t i = 0; i < trace.size(); ++i) {
    for (std::size_t k = 0; k < columns.size(); ++k) {
      row[k] = columns[k][i];
    }
    check(file.rows(row));
  }
  if (trace.is_complete()) {
    check(file.commit());
  } else {
    file.abandon();
  }
}

}  // namespace

void bind_trace(py::module_& module) {
  py::class_<MemoryTrace, std::shared_ptr<MemoryTrace>>(module, "Trace")
      .def("column", &column_of, py::arg("name"))
      .def_property_readonly("columns",
                             [](const MemoryTrace& trace) {
                               py::list names;
                               for (const TraceColumn& column : trace.header().columns) {
                                 names.append(column.name);
                               }
                               return py::tuple(names);
                             })
      .def_property_readonly("units",
                             [](const MemoryTrace& trace) {
                               py::dict units;
                               for (const TraceColumn& column : trace.header().columns) {
                                 if (!column.unit.empty() && column.unit != "1") {
                                   units[py::str(column.name)] = column.unit;
                                 }
                               }
                               return units;
                             })
      .def_property_readonly("period_s",
                             [](const MemoryTrace& trace) { return trace.header().period; })
      .def_property_readonly("rows", &MemoryTrace::size)
      .def_property_readonly("is_complete", &MemoryTrace::is_complete)
      .def("write_csv", &write_csv, py::arg("folder"), py::call_guard<py::gil_scoped_release>())
      .def("write_hdf5", &write_hdf5, py::arg("program"), py::arg("settings"), py::arg("summary"),
           py::arg("folder"), py::call_guard<py::gil_scoped_release>());
  module.def(
      "read_trace",
      [](const std::string& file) {
        auto trace = std::make_shared<MemoryTrace>();
        read_trace(file, *trace);
        return trace;
      },
      py::arg("file"), py::call_guard<py::gil_scoped_release>());
}

}  // namespace twin::python
