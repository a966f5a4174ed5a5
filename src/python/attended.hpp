#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <future>

namespace twin::python {

/// Does long work beside the interpreter: other Python threads go on, and Ctrl-C ends the work.
///
/// The work runs in a thread of its own. Meanwhile the calling thread, without the interpreter's
/// lock, looks now and then whether a signal has come for Python. If its handler raises an
/// exception, as that of Ctrl-C does, the work is told to end; once it has ended, which brakes a
/// machine that moves, the exception goes on its way.
///
/// @param end   tells the work to end early; called at most once
/// @param work  called once, without the interpreter's lock
template <class End, class Work>
auto attended(End end, Work work) {
  namespace py = pybind11;
  constexpr std::chrono::milliseconds kLook{20};
  bool is_interrupted = false;
  py::error_scope interruption;  // what the handler has raised, kept while the work ends
  std::future<decltype(work())> result;
  {
    py::gil_scoped_release released;
    result = std::async(std::launch::async, std::move(work));
    while (result.wait_for(kLook) != std::future_status::ready) {
      if (!is_interrupted) {
        py::gil_scoped_acquire acquired;
        if (PyErr_CheckSignals() != 0) {
          PyErr_Fetch(&interruption.type, &interruption.value, &interruption.trace);
          is_interrupted = true;
          end();
        }
      }
    }
  }
  if (is_interrupted) {
    try {
      result.get();
    } catch (const std::exception&) {  // an error of the interrupted work is no news
    }
    PyErr_Restore(interruption.type, interruption.value, interruption.trace);
    interruption.type = interruption.value = interruption.trace = nullptr;
    throw py::error_already_set();
  }
  return result.get();
}

/// The same for work that ends early once a flag is set.
/// @param work  called once with the flag, a `std::atomic<bool>*`
template <class Work>
auto stoppable(Work work) {
  std::atomic<bool> stop{false};
  return attended([&stop] { stop = true; }, [&stop, &work] { return work(&stop); });
}

}  // namespace twin::python
