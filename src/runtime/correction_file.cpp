#include "runtime/correction_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <map>
#include <string_view>
#include <vector>

#include "core/atomic_file.hpp"
#include "core/sha256.hpp"
#include "core/units.hpp"
#include "gcode/reader.hpp"
#include "runtime/run_options.hpp"

namespace twin::runtime {
namespace {

constexpr std::string_view kFirstLine = "# twin correction 1";
constexpr std::string_view kHeader = "x_set_mm,y_set_mm,z_set_mm,x_offset_um,y_offset_um";
constexpr std::size_t kColumns = 5;
constexpr std::string_view kAgain = "; make it again with twin compensate";

/// Goes through the whole program once, so that its subprograms are known.
std::string hash_of_program(const gcode::ProgramText& program, const config::MachineFile& machine) {
  gcode::Reader reader(program, reader_options(machine, std::nullopt));
  for (auto block = reader.next(); block && *block; block = reader.next()) {
  }
  Sha256 hash;
  hash.add(program.sha256());
  for (const gcode::ProgramText& part : program.subprograms()) {
    hash.add(part.file().filename().string());
    hash.add(part.sha256());
  }
  return hash.finish();
}

std::string hash_of_machine(const config::MachineFile& machine) {
  config::MachineFile copy = machine;
  copy.rig = {};
  copy.safety = {};
  copy.realtime = {};
  copy.home = {};
  copy.compensation.limit = 0.0;
  copy.uncertainty = {};
  copy.shadow = {};
  copy.table.model = std::filesystem::path(machine.table.model).filename().string();
  for (hal::mujoco::AxisParams& axis : copy.table.axis) {
    axis.encoder.phase = 0.5;
    axis.drive.hum_phase = 0.0;
  }
  return sha256(config::to_toml(copy, [](const std::string&) { return std::string("-"); }));
}

std::string feedrate_text(const std::optional<double>& feedrate) {
  return feedrate ? fmt::format("{}", units::mm_per_min_from_mm_per_s(*feedrate)) : "programmed";
}

/// Reads the lines of a correction one by one.
class CorrectionReader {
 public:
  CorrectionReader(const std::filesystem::path& file, std::string_view text)
      : file_(file), rest_(text) {}

  Expected<motion::Correction> read(const CorrectionOrigin& wanted, double limit) {
    if (!next() || line_ != kFirstLine) {
      return error(
          fmt::format("this is no correction: expected '{}' in the first line", kFirstLine));
    }
    std::map<std::string, std::string> said;
    while (next() && line_.starts_with("# ")) {
      const std::size_t equals = line_.find(" = ");
      if (equals != std::string_view::npos) {
        said[std::string(line_.substr(2, equals - 2))] = std::string(line_.substr(equals + 3));
      }
    }
    TWIN_CHECK(compare(said, wanted));
    if (line_ != kHeader) {
      return error(
          fmt::format("'{}' where the header '{}' is expected", line_.substr(0, 60), kHeader));
    }
    motion::Correction correction;
    while (next()) {
      TWIN_CHECK(take_row(limit, correction));
    }
    if (correction.offsets.empty() ||
        said["periods"] != std::to_string(correction.offsets.size())) {
      return error(fmt::format("it has {} rows and should have {}: a part of it is missing",
                               correction.offsets.size(), said["periods"]));
    }
    return correction;
  }

 private:
  bool next() {
    if (rest_.empty()) {
      return false;
    }
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    line_ = rest_.substr(0, end);
    if (line_.ends_with('\r')) {
      line_.remove_suffix(1);
    }
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++number_;
    return true;
  }

  tl::unexpected<Error> error(std::string message, int column = 0) const {
    return tl::unexpected(
        Error{ErrorCode::kFile, std::move(message), file_.string(), number_, column});
  }

  Expected<void> compare(std::map<std::string, std::string>& said,
                         const CorrectionOrigin& wanted) const {
    if (said["program_sha256"] != wanted.program_sha256) {
      return error(fmt::format("the correction was made for another program ({}) than {}{}",
                               said["program"], wanted.program, kAgain));
    }
    if (said["period_s"] != fmt::format("{}", wanted.period)) {
      return error(
          fmt::format("the correction was made for a period of {} s, the machine has {} s{}",
                      said["period_s"], wanted.period, kAgain));
    }
    if (said["machine_sha256"] != wanted.machine_sha256) {
      return error(
          fmt::format("the correction was made for other settings of the machine ({}) than "
                      "those of {}{}",
                      said["machine"], wanted.machine, kAgain));
    }
    if (said["feedrate_mm_per_min"] != feedrate_text(wanted.feedrate)) {
      return error(fmt::format("the correction was made for feedrate {} mm/min, this run has {}{}",
                               said["feedrate_mm_per_min"], feedrate_text(wanted.feedrate),
                               kAgain));
    }
    return {};
  }

  Expected<void> take_row(double limit, motion::Correction& correction) const {
    std::array<double, kColumns> values{};
    const char* at = line_.data();
    const char* const end = at + line_.size();
    for (std::size_t i = 0; i < kColumns; ++i) {
      const auto [after, code] = std::from_chars(at, end, values[i]);
      const bool ends_well = i + 1 < kColumns ? after != end && *after == ',' : after == end;
      if (code != std::errc() || !ends_well || !std::isfinite(values[i])) {
        return error(fmt::format("'{}': expected {} finite numbers, {}", line_.substr(0, 60),
                                 kColumns, kHeader),
                     static_cast<int>(at - line_.data()) + 1);
      }
      at = after + 1;
    }
    const Vec2 offset(units::mm_from_um(values[3]), units::mm_from_um(values[4]));
    if (offset.lpNorm<Eigen::Infinity>() > limit * (1.0 + 1e-9)) {
      return error(fmt::format("an offset of {:g} um is beyond compensation.limit_mm = {:g}",
                               units::um_from_mm(offset.lpNorm<Eigen::Infinity>()), limit));
    }
    correction.points.emplace_back(values[0], values[1], values[2]);
    correction.offsets.push_back(offset);
    return {};
  }

  const std::filesystem::path& file_;
  std::string_view rest_;
  std::string_view line_;
  int number_ = 0;
};

}  // namespace

config::MachineFile planned_with_reserve(const config::MachineFile& machine) {
  config::MachineFile planned = machine;
  planned.planning.corner_error =
      std::min(machine.planning.corner_error, machine.compensation.path_tolerance);
  const double share = 1.0 - machine.compensation.reserve;
  planned.limits.acceleration *= share;
  planned.limits.jerk *= share;
  planned.limits.axis_acceleration *= share;
  planned.limits.axis_jerk *= share;
  return planned;
}

CorrectionOrigin correction_origin(const gcode::ProgramText& program,
                                   const config::MachineFile& machine,
                                   const std::optional<double>& feedrate) {
  return {.program = program.file().filename().string(),
          .program_sha256 = hash_of_program(program, machine),
          .machine = machine.name,
          .machine_sha256 = hash_of_machine(machine),
          .period = machine.period,
          .feedrate = feedrate};
}

Expected<void> write_correction(const std::filesystem::path& file,
                                const motion::Correction& correction,
                                const CorrectionOrigin& origin, const std::string& remark) {
  std::string text = fmt::format(
      "{}\n# {}\n# program = {}\n# program_sha256 = {}\n# machine = {}\n# machine_sha256 = {}\n"
      "# period_s = {}\n# feedrate_mm_per_min = {}\n# periods = {}\n{}\n",
      kFirstLine, remark, origin.program, origin.program_sha256, origin.machine,
      origin.machine_sha256, origin.period, feedrate_text(origin.feedrate),
      correction.offsets.size(), kHeader);
  for (std::size_t k = 0; k < correction.offsets.size(); ++k) {
    const Vec3& point = correction.points[k];
    const Vec2& offset = correction.offsets[k];
    text += fmt::format("{},{},{},{},{}\n", point.x(), point.y(), point.z(),
                        units::um_from_mm(offset.x()), units::um_from_mm(offset.y()));
  }
  return write_whole_file(file, text);
}

Expected<motion::Correction> read_correction(const std::filesystem::path& file,
                                             const CorrectionOrigin& wanted, double limit) {
  TWIN_TRY(const std::string text, read_whole_file(file));
  return CorrectionReader(file, text).read(wanted, limit);
}

std::string correction_note(const motion::CorrectionFollower& follower, double period) {
  if (follower.left_at() < 0) {
    return "the set points are corrected; planned with compensation.path_tolerance and reserve";
  }
  return fmt::format(
      "the correction faded out from {:.3f} s on, where the motion left the plan that it was made "
      "for",
      static_cast<double>(follower.left_at()) * period);
}

}  // namespace twin::runtime
