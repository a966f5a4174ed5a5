#include <fmt/format.h>
#include <fmt/ranges.h>

#include <system_error>

#include "cli/commands.hpp"
#include "config/find_file.hpp"
#include "config/nearest_name.hpp"
#include "core/atomic_file.hpp"
#include "core/units.hpp"
#include "session/results.hpp"
#include "studies/convert/comparison.hpp"
#include "studies/convert/converter.hpp"
#include "studies/convert/dialect.hpp"

namespace twin::cli {
namespace {

/// Empty for the name of a dialect, else what is wrong with it.
std::string check_dialect(const std::string& name) {
  if (studies::convert::make_dialect(name) != nullptr) {
    return {};
  }
  const std::vector<std::string> names = studies::convert::dialect_names();
  return fmt::format("unknown dialect {}{} (there are {})", name, config::did_you_mean(name, names),
                     fmt::join(names, ", "));
}

namespace fs = std::filesystem;

constexpr double kRounding = 2e-6;  // of the coordinates in the file [mm]

/// Form in which a dialect that this reader does not read is read back: the same curves with the
/// same digits.
constexpr std::string_view kReadable = "g6.2";

struct Job {
  fs::path program;
  gcode::ReaderOptions reading;
  config::MachineFile machine;
};

Expected<studies::convert::Conversion> convert_to(const Job& job,
                                                  const studies::convert::Dialect& dialect) {
  auto reader = gcode::Reader::open(job.program.string(), job.reading);
  if (!reader) {
    return tl::unexpected(reader.error());
  }
  auto conversion = studies::convert::convert_program(
      *reader, job.reading.start, job.program.filename().string(), dialect, job.machine.path,
      job.machine.planning, job.machine.limits);
  if (!conversion && conversion.error().file.empty()) {
    conversion.error().file = job.program.string();
  }
  return conversion;
}

/// Reads the new program back and holds it against the old one.
Expected<studies::convert::Deviation> check(const Job& job,
                                            const studies::convert::Conversion& conversion) {
  auto before = gcode::Reader::open(job.program.string(), job.reading);
  if (!before) {
    return tl::unexpected(before.error());
  }
  gcode::ReaderOptions reading;
  reading.start = job.reading.start;
  auto after = gcode::Reader::from_text(conversion.text, "the converted program", reading);
  auto deviation = studies::convert::compare_programs(*before, after, conversion.groups);
  if (deviation && deviation->largest > deviation->tolerance + kRounding) {
    return tl::unexpected(Error{
        ErrorCode::kProgram,
        fmt::format("the converted program would be {:.3f} um from this line, its tolerance "
                    "is {:g} um; nothing was written",
                    units::um_from_mm(deviation->largest), units::um_from_mm(deviation->tolerance)),
        job.program.string(), static_cast<int>(deviation->line), 0});
  }
  return deviation;
}

Expected<studies::convert::Deviation> check_as_readable(
    const Job& job, const std::string& dialect, const studies::convert::Conversion& conversion) {
  if (studies::convert::is_readable(dialect)) {
    return check(job, conversion);
  }
  auto readable = convert_to(job, *studies::convert::make_dialect(kReadable));
  return readable ? check(job, *readable) : tl::unexpected<Error>(readable.error());
}

fs::path output_of(const Options& options, const fs::path& program,
                   const studies::convert::Dialect& dialect) {
  if (!options.out.empty()) {
    return options.out;
  }
  const std::string name =
      fmt::format("{}.{}{}", program.stem().string(), dialect.name(), dialect.extension());
  return fs::path("renders") / program.stem() / name;
}

void print(const Job& job, const studies::convert::Dialect& dialect,
           const studies::convert::Conversion& c, const studies::convert::Deviation& deviation) {
  fmt::print("{} for {}\n\n", job.program.filename().string(), dialect.control());
  fmt::print("  {:<26}{:>12}{:>12}\n", "", "before", "after");
  fmt::print("  {:<26}{:>12}{:>12}\n", "lines of text", c.lines_before, c.lines);
  std::int64_t made = 0;
  for (const studies::convert::Group& group : c.groups) {
    made += group.made;
  }
  fmt::print("  {:<26}{:>12}{:>12}\n", "blocks", c.blocks, made);
  fmt::print("  {:<26}{:>12}{:>12}\n", "of them in curves", c.fitted_blocks, c.nurbs.blocks);
  fmt::print("  {:<26}{:>12}{:>12}\n", "control points", "", c.nurbs.control_points);
  if (dialect.name() == "g5.2" && c.nurbs.blocks > 0) {
    fmt::print("  curves: {} on new uniform knots, {} as {} exact pieces\n", c.nurbs.refitted,
               c.curves - c.nurbs.refitted, c.nurbs.blocks - c.nurbs.refitted);
  }
  fmt::print(
      "\n  largest deviation from the programmed path, read back{}: {:.3f} um of {:g} um, "
      "line {}\n",
      studies::convert::is_readable(dialect.name()) ? "" : " as G6.2",
      units::um_from_mm(deviation.largest), units::um_from_mm(deviation.tolerance), deviation.line);
}

Expected<void> convert_command(const Options& options) {
  auto machine = read_machine(options);
  if (!machine) {
    return tl::unexpected(machine.error());
  }
  auto program = config::find_program(options.programs.front());
  if (!program) {
    return tl::unexpected(program.error());
  }
  const auto dialect = studies::convert::make_dialect(options.dialect);
  const fs::path file = output_of(options, *program, *dialect);
  if (auto prepared = session::prepare_output_file(file); !prepared) {
    return prepared;
  }
  std::error_code ignored;
  if (fs::equivalent(file, *program, ignored)) {
    return fail(ErrorCode::kUsage, "--out " + file.string() + " is the program itself");
  }
  Job job{*program, {}, *machine};
  job.reading.feedrate = feedrate_of(options);
  auto conversion = convert_to(job, *dialect);
  if (!conversion) {
    return tl::unexpected(conversion.error());
  }
  auto deviation = check_as_readable(job, options.dialect, *conversion);
  if (!deviation) {
    return tl::unexpected(deviation.error());
  }
  if (auto written = write_whole_file(file, conversion->text); !written) {
    return written;
  }
  if (!options.quiet) {
    print(job, *dialect, *conversion, *deviation);
    fmt::print("written to {}\n", file.string());
  }
  return {};
}

}  // namespace

Command add_convert(const CommandContext& context) {
  Options& options = context.options;
  CLI::App* const app = context.app.add_subcommand(
      "convert", "Write a program as NURBS blocks of a control; runs of short blocks are fitted");
  add_program_options(*app, options);
  app->add_option("--to", options.dialect,
                  "g5.2: LinuxCNC; g6.2: LinuxCNC 2.10; fanuc: G06.2; bspline: SINUMERIK")
      ->required()
      ->check(check_dialect)
      ->type_name("DIALECT");
  add_machine_options(*app, options);
  add_interpolator_option(*app, options);
  app->add_option("--out", options.out, "File to write [renders/PROGRAM/PROGRAM.DIALECT.nc]")
      ->type_name("FILE");
  app->add_flag("--quiet", options.quiet, "Print errors only");
  return {app, [&options] { return convert_command(options); }};
}

}  // namespace twin::cli
