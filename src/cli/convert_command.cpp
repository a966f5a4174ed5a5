#include <fmt/format.h>
#include <fmt/ranges.h>

#include <system_error>

#include "cli/commands.hpp"
#include "cli/machines.hpp"
#include "config/find_file.hpp"
#include "config/nearest_name.hpp"
#include "core/atomic_file.hpp"
#include "session/results.hpp"
#include "studies/convert/checked_conversion.hpp"
#include "studies/convert/dialect.hpp"

namespace twin::cli {
namespace {

/// The file that is written: that of --out, or one below renders.
std::filesystem::path converted_file(const ConvertArguments& arguments,
                                     const std::filesystem::path& program) {
  if (!arguments.file.empty()) {
    return arguments.file;
  }
  const auto dialect = studies::convert::make_dialect(arguments.dialect);
  const std::string name =
      fmt::format("{}.{}{}", program.stem().string(), dialect->name(), dialect->extension());
  return std::filesystem::path("renders") / program.stem() / name;
}

}  // namespace

std::string dialect_error(const std::string& name) {
  if (studies::convert::make_dialect(name) != nullptr) {
    return {};
  }
  const std::vector<std::string> names = studies::convert::dialect_names();
  return fmt::format("unknown dialect {}{} (there are {})", name, config::did_you_mean(name, names),
                     fmt::join(names, ", "));
}

Expected<void> execute(const ConvertArguments& arguments, const Environment&) {
  TWIN_TRY(const auto machine, read_machine(arguments.machine, arguments.verbosity));
  TWIN_TRY(const auto program, config::find_program(arguments.program.name));
  const std::filesystem::path file = converted_file(arguments, program);
  TWIN_CHECK(session::prepare_output_file(file));
  std::error_code ignored;
  if (std::filesystem::equivalent(file, program, ignored)) {
    return fail(ErrorCode::kUsage, "--out " + file.string() + " is the program itself");
  }
  studies::convert::Job job{program, {}, machine.path, machine.planning, machine.limits};
  job.reading.feedrate = arguments.program.feedrate;
  TWIN_TRY(const auto checked, studies::convert::convert_and_check(job, arguments.dialect));
  TWIN_CHECK(write_whole_file(file, checked.conversion.text));
  if (arguments.verbosity == Verbosity::kNormal) {
    fmt::print("{}written to {}\n", studies::convert::to_table(job, arguments.dialect, checked),
               file.string());
  }
  return {};
}

}  // namespace twin::cli
