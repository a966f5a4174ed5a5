#include "python/bindings.hpp"

namespace twin::python {
namespace py = pybind11;
namespace {

const char* name_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::kUsage:
      return "usage";
    case ErrorCode::kProgram:
      return "program";
    case ErrorCode::kFile:
      return "file";
    case ErrorCode::kModel:
      return "model";
    case ErrorCode::kMachine:
      return "machine";
    case ErrorCode::kHost:
      return "host";
    case ErrorCode::kInterrupted:
      return "interrupted";
  }
  return "unknown";
}

/// The class twin.Error; never released, since the interpreter may end before this library.
py::handle error_class;

}  // namespace

py::object error_object(const Error& error) {
  return error_class(error.message, error.file, error.line, error.column, name_of(error.code));
}

void bind_errors(py::module_& module) {
  error_class = py::object(py::module_::import("twin._error").attr("Error")).release();
  module.attr("Error") = error_class;
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) {
        std::rethrow_exception(thrown);
      }
    } catch (const Failure& failure) {
      PyErr_SetObject(error_class.ptr(), error_object(failure.error()).ptr());
    }
  });
}

}  // namespace twin::python
