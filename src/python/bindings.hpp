#pragma once

#include <pybind11/pybind11.h>

#include <array>
#include <memory>

#include "twin/twin.hpp"

/// The Python module `twin._twin`: the public headers <twin/...> as Python classes. The package
/// `twin`, written in Python, gives them their final form.
namespace twin::python {

/// The machine of a name: "mujoco", "ideal" or "emulated_rig".
/// @throws Failure for another name
std::unique_ptr<Machine> make_machine(const std::string& hal, const Settings& settings,
                                      const std::vector<std::string>& faults);

/// Three numbers as a Python tuple.
template <std::size_t n>
pybind11::tuple tuple_of(const std::array<double, n>& values) {
  pybind11::tuple result(n);
  for (std::size_t i = 0; i < n; ++i) {
    result[i] = values[i];
  }
  return result;
}

void bind_errors(pybind11::module_& module);
void bind_settings(pybind11::module_& module);
void bind_program(pybind11::module_& module);
void bind_trace(pybind11::module_& module);
void bind_run(pybind11::module_& module);
void bind_identify(pybind11::module_& module);
void bind_plant(pybind11::module_& module);
void bind_studies(pybind11::module_& module);
void bind_batch(pybind11::module_& module);
void bind_set_points(pybind11::module_& module);

}  // namespace twin::python
