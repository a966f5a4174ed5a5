#include "runtime/run_errors.hpp"

#include <fmt/format.h>

#include <exception>
#include <string>

namespace twin::runtime {

Error thrown(const char* where) {
  std::string what = "unknown exception";
  try {
    throw;
  } catch (const std::exception& exception) {
    what = exception.what();
  } catch (...) {
  }
  return {.code = ErrorCode::kMachine,
          .message = fmt::format("{} failed: {}", where, what),
          .file = {}};
}

std::optional<Error> describe_end(const MotionResult& motion, const results::Sample& last,
                                  const hal::Machine* hal) {
  const auto at = fmt::format("at t = {:.3f} s, NC line {}", last.t, last.line);
  switch (motion.end) {
    case MotionEnd::kDone:
      return std::nullopt;
    case MotionEnd::kInterrupted:
      return fail(ErrorCode::kInterrupted, "interrupted: stopped on the path " + at).value();
    case MotionEnd::kMachineError:
      return fail(ErrorCode::kMachine, fmt::format("machine '{}' failed {}: {}", hal->info().name,
                                                   at, hal->last_error()))
          .value();
    case MotionEnd::kTripped:
      return fail(ErrorCode::kMachine, motion::describe(*motion.trip)).value();
  }
  return std::nullopt;
}

}  // namespace twin::runtime
