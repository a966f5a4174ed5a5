#include "runtime/run_errors.hpp"

#include <fmt/format.h>

#include <exception>
#include <new>
#include <string>
#include <system_error>

#include "config/loop_margins.hpp"

namespace twin::runtime {

Error thrown(const char* where) {
  std::string what = "unknown exception";
  ErrorCode code = ErrorCode::kMachine;
  try {
    throw;
  } catch (const std::bad_alloc&) {
    what = "no memory is left";
    code = ErrorCode::kHost;
  } catch (const std::system_error& exception) {
    what = exception.what();
    code = ErrorCode::kHost;
  } catch (const std::exception& exception) {
    what = exception.what();
  } catch (...) {
  }
  return {.code = code, .message = fmt::format("{} failed: {}", where, what), .file = {}};
}

std::optional<Error> describe_end(const MotionResult& motion, const results::Sample& last,
                                  const hal::Machine* hal, const std::string& advice) {
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
      return fail(ErrorCode::kMachine, motion::describe(*motion.trip, advice)).value();
  }
  return std::nullopt;
}

std::string advice_on_loop(const motion::Trip& trip, const config::MachineFile& machine) {
  constexpr double kNearlyUnstable = 1.15;  // gain margin below which the loop rings for long
  if (trip.axis >= hal::kServoAxes ||
      (trip.kind != motion::Kind::kRunaway && trip.kind != motion::Kind::kTrackingError &&
       trip.kind != motion::Kind::kSaturation)) {
    return {};
  }
  const config::LoopMargins margins =
      config::loop_margins(machine.servo[trip.axis], machine.table.axis[trip.axis], machine.period);
  if (margins.is_stable() && margins.gain_margin > kNearlyUnstable) {
    return {};
  }
  return fmt::format(
      "the position loop is {} (gain margin {:.2f}, phase margin {:.1f} deg at {:.1f} Hz): with "
      "servo.{}.kp_per_s below {:.0f} it is stable",
      margins.is_stable() ? "nearly unstable" : "unstable", margins.gain_margin,
      margins.phase_margin_deg, margins.crossover_Hz, "xy"[trip.axis],
      machine.servo[trip.axis].kp * margins.gain_margin);
}

}  // namespace twin::runtime
