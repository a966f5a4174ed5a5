#include "runtime/program_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <string>
#include <utility>
#include <variant>

#include "core/stop_wish.hpp"
#include "gcode/reader.hpp"
#include "gcode/start.hpp"

namespace twin::runtime {
namespace {

constexpr const char* kReportInterrupted = "interrupted: nothing has moved";
constexpr std::size_t kMostTools = 1000;  // that are told apart
constexpr int kPlainOffsets = 6;          // G54 to G59
constexpr int kNumberedOffsets = 9;       // and G59.1 to G59.3

/// Gathers the tools and the time that goes by with each. Blocks may come in another thread than
/// segments.
class ToolWatch {
 public:
  explicit ToolWatch(ProgramReport& report) : report_(report) {}

  void add(const gcode::Block& block) {
    if (changes_.empty() || tool_of_last_ != block.tool) {
      const std::lock_guard lock(mutex_);
      changes_.push_back({moves_, place_of(block)});
      tool_of_last_ = block.tool;
    }
    report_.work_offsets.insert(block.work_offset);
    if (block.motion != gcode::Motion::kDwell) {
      ++report_.tools[changes_.back().place].blocks;
      ++moves_;
    }
  }

  void add(const feedrate::PlannedSegment& planned) {
    const std::lock_guard lock(mutex_);
    double time = 0.0;
    for (const feedrate::Phase& phase : planned.phases) {
      time += phase.duration;
    }
    const path::Segment& segment = planned.segment;
    const bool is_rest = std::holds_alternative<std::monostate>(segment.geometry);
    (is_rest            ? report_.shares.rest
     : segment.is_rapid ? report_.shares.rapid
                        : report_.shares.feed) += time;
    if (!segment.marks.empty()) {
      block_ = segment.marks.back().block;
    }
    while (next_ + 1 < changes_.size() && changes_[next_ + 1].move <= block_) {
      ++next_;
    }
    if (!changes_.empty()) {
      report_.tools[changes_[next_].place].time += time;
    }
  }

 private:
  /// From which move on which of the tools is in the spindle.
  struct Change {
    std::int64_t move;
    std::size_t place;
  };

  std::size_t place_of(const gcode::Block& block) {
    auto& tools = report_.tools;
    const auto known = std::find_if(tools.begin(), tools.end(),
                                    [&](const ToolUse& use) { return use.number == block.tool; });
    if (known != tools.end()) {
      return static_cast<std::size_t>(known - tools.begin());
    }
    if (tools.size() < kMostTools) {
      tools.push_back({block.tool, block.line, 0, 0.0});
    }
    return tools.size() - 1;
  }

  ProgramReport& report_;
  std::mutex mutex_;  // for changes_ and the length of report_.tools, which blocks change
  std::vector<Change> changes_;
  int tool_of_last_ = 0;
  std::int64_t moves_ = 0;
  std::int64_t block_ = 0;
  std::size_t next_ = 0;
};

/// Adds an error, or counts it if another line has had the same.
void add_error(Error error, ProgramReport& report) {
  const auto known =
      std::find_if(report.errors.begin(), report.errors.end(), [&error](const ProgramError& other) {
        return other.error.message == error.message && other.error.file == error.file;
      });
  if (known == report.errors.end()) {
    report.errors.push_back({std::move(error), 1});
  } else {
    ++known->count;
  }
}

/// Reads on behind an error, to find the others.
Expected<void> collect_errors(gcode::Reader& reader, TravelCheck& check, Error first,
                              std::size_t most_errors, const std::atomic<bool>* stop,
                              ProgramReport& report) {
  std::optional<Error> error = std::move(first);
  std::string last;
  while (true) {
    if (error) {
      if (error->code != ErrorCode::kProgram) {
        return tl::unexpected(*std::move(error));
      }
      last = to_string(*error);
      add_error(*std::move(error), report);
      error.reset();
      if (report.errors.size() >= most_errors) {
        report.has_more_errors = true;
        return {};
      }
    }
    TWIN_CHECK(check_wish(stop, kReportInterrupted));
    auto block = reader.next();
    if (!block && !reader.resume()) {
      if (to_string(block.error()) != last) {
        add_error(std::move(block).error(), report);
      }
      return {};
    }
    if (!block) {
      error = std::move(block).error();
    } else if (!*block) {
      return {};
    } else if (auto added = check.add(**block); !added) {
      error = std::move(added).error();
    }
  }
}

void sort_notes(const gcode::Notes& notes, ProgramReport& report) {
  report.notes = notes.all();
  report.notes_left_out = notes.left_out();
  std::stable_sort(report.notes.begin(), report.notes.end(),
                   [](const gcode::Note& a, const gcode::Note& b) { return a.kind < b.kind; });
}

}  // namespace

Expected<ProgramReport> report_program(const gcode::ProgramText& program,
                                       const gcode::ReaderOptions& options,
                                       const config::MachineFile& machine, std::size_t most_errors,
                                       const std::atomic<bool>* stop) {
  ProgramReport report;
  gcode::Reader reader(program, options);
  TravelCheck check(program.file().string(), gcode::start_of(program, options), machine.limits);
  ToolWatch watch(report);
  const auto plan = plan_program(
      reader, machine,
      [&](feedrate::PlannedSegment&& planned) {
        watch.add(planned);
        return true;
      },
      [&](const gcode::Block& block) {
        watch.add(block);
        return check_wish(stop, kReportInterrupted).and_then([&] { return check.add(block); });
      },
      PlanThreads::kBeside);
  if (plan) {
    report.machining_time = plan->time;
  } else {
    reader.resume();
    TWIN_CHECK(collect_errors(reader, check, plan.error(), most_errors, stop, report));
  }
  report.program = check.figures();
  report.program.lines = reader.line();
  sort_notes(reader.notes(), report);
  return report;
}

std::string name_of_work_offset(int work_offset) {
  if (work_offset < kPlainOffsets) {
    return fmt::format("G{}", 54 + work_offset);
  }
  if (work_offset < kNumberedOffsets) {
    return fmt::format("G59.{}", work_offset - kPlainOffsets + 1);
  }
  return fmt::format("G54.1 P{}", work_offset - kNumberedOffsets + 1);
}

}  // namespace twin::runtime
