#include "studies/batch/job_file.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <fstream>

#include "config/nearest_name.hpp"
#include "core/atomic_file.hpp"
#include "core/json.hpp"
#include "core/units.hpp"

namespace twin::studies::batch {
namespace {

constexpr int kMostSettings = 1000;

std::optional<results::TraceFiles> trace_of(bool is_kept) {
  return is_kept ? results::TraceFiles::kCsv : results::TraceFiles::kNone;
}

/// Reads the values of a job's JSON, and says where one is none.
class JobReader {
 public:
  JobReader(const Json& json, const std::filesystem::path& file, int line)
      : json_(json), file_(file), line_(line) {}

  Expected<Job> read() {
    Job job;
    for (const auto& [key, value] : json_.items()) {
      TWIN_CHECK(take(key, value, job));
    }
    if (job.program.empty()) {
      return wrong("has no \"program\"; expected the name of an NC program");
    }
    return job;
  }

 private:
  tl::unexpected<Error> wrong(std::string message) const {
    return tl::unexpected(
        Error{ErrorCode::kUsage, "the job " + std::move(message), file_.string(), line_, 0});
  }
  tl::unexpected<Error> wrong(const std::string& key, const Json& value,
                              std::string_view expected) const {
    return wrong(fmt::format("has {} = {}; expected {}", key, twin::to_line(value), expected));
  }

  Expected<void> take(const std::string& key, const Json& value, Job& job) {
    if (key == "program" || key == "machine") {
      return take_text(key, value, key == "program" ? job.program : job.machine);
    }
    if (key == "set") {
      return take_settings(value, job);
    }
    if (key == "feedrate_mm_per_min") {
      if (!value.is_number() || !(value.get<double>() > 0.0)) {
        return wrong(key, value, "a number above 0");
      }
      job.feedrate = units::mm_per_s_from_mm_per_min(value.get<double>());
      return {};
    }
    if (key == "hal") {
      return take_hal(value, job);
    }
    if (key == "overrides") {
      return take_overrides(value, job);
    }
    if (key == "trace") {
      const auto trace = value.is_boolean() ? trace_of(value.get<bool>())
                         : value.is_string()
                             ? results::trace_files_of(value.get_ref<const std::string&>())
                             : std::nullopt;
      if (!trace) {
        return wrong(key, value, "true, false, \"csv\", \"hdf5\", \"both\" or \"none\"");
      }
      job.trace = *trace;
      return {};
    }
    const std::array<std::string, 7> keys{"program", "machine",   "set",  "feedrate_mm_per_min",
                                          "hal",     "overrides", "trace"};
    return wrong(fmt::format("has an unknown key \"{}\"{}", key, config::did_you_mean(key, keys)));
  }

  Expected<void> take_text(const std::string& key, const Json& value, std::string& text) {
    if (!value.is_string() || value.get_ref<const std::string&>().empty()) {
      return wrong(key, value, "the name of a file");
    }
    text = value.get<std::string>();
    return {};
  }

  Expected<void> take_settings(const Json& value, Job& job) {
    if (!value.is_object() || value.size() > kMostSettings) {
      return wrong("set", value, "an object of settings: {\"servo.x.kp_per_s\": 200}");
    }
    for (const auto& [key, setting] : value.items()) {
      if (setting.is_object() || setting.is_null()) {
        return wrong("set " + key, setting, "a number, a text or a list of numbers");
      }
      job.settings.push_back(
          key + "=" + (setting.is_string() ? setting.get<std::string>() : twin::to_line(setting)));
    }
    return {};
  }

  Expected<void> take_hal(const Json& value, Job& job) {
    for (const JobMachine machine : {JobMachine::kTable, JobMachine::kIdeal, JobMachine::kNone}) {
      if (value == name_of(machine)) {
        job.hal = machine;
        return {};
      }
    }
    return wrong("hal", value, "\"mujoco\", \"ideal\" or \"none\"");
  }

  Expected<void> take_overrides(const Json& value, Job& job) {
    constexpr const char* kExpected = "pairs of seconds, ascending, and percent, 0 to 200";
    if (!value.is_array()) {
      return wrong("overrides", value, kExpected);
    }
    double last = 0.0;
    for (const Json& pair : value) {
      const bool is_pair = pair.is_array() && pair.size() == 2 && pair[0].is_number() &&
                           pair[1].is_number() && pair[0].get<double>() >= last &&
                           pair[1].get<double>() >= 0.0 &&
                           pair[1].get<double>() <= runtime::kHighestOverride;
      if (!is_pair) {
        return wrong("overrides", value, kExpected);
      }
      last = pair[0].get<double>();
      job.overrides.push_back({last, pair[1].get<double>()});
    }
    return {};
  }

  const Json& json_;
  const std::filesystem::path& file_;
  int line_;
};

}  // namespace

Expected<Job> parse_job(std::string_view text, const std::filesystem::path& file, int line) {
  const Json json = parse_json(text);
  if (json.is_discarded()) {
    return tl::unexpected(Error{ErrorCode::kUsage, "is no JSON; expected one job, {...}",
                                file.string(), line, static_cast<int>(json_error(text))});
  }
  if (!json.is_object()) {
    return tl::unexpected(
        Error{ErrorCode::kUsage, "is no job; expected an object, {...}", file.string(), line, 1});
  }
  return JobReader(json, file, line).read();
}

Expected<std::vector<Job>> read_jobs(const std::filesystem::path& file) {
  std::ifstream input(file);
  if (!input) {
    return file_error(file, "read", errno);
  }
  std::vector<Job> jobs;
  std::string text;
  for (int line = 1; std::getline(input, text); ++line) {
    if (text.find_first_not_of(" \t\r") == std::string::npos) {
      continue;
    }
    if (jobs.size() >= kMostJobs) {
      return tl::unexpected(Error{ErrorCode::kUsage,
                                  fmt::format("more than {} jobs; split the file", kMostJobs),
                                  file.string(), line, 0});
    }
    TWIN_TRY(Job job, parse_job(text, file, line));
    jobs.push_back(std::move(job));
  }
  if (input.bad()) {
    return file_error(file, "read", errno);
  }
  if (jobs.empty()) {
    return tl::unexpected(
        Error{ErrorCode::kUsage, "has no job; expected one a line, {...}", file.string(), 0, 0});
  }
  return jobs;
}

std::string to_line(const Job& job) {
  Json json;
  json["program"] = job.program;
  json["machine"] = job.machine;
  for (const std::string& setting : job.settings) {
    const std::size_t equals = setting.find('=');
    const std::string value = setting.substr(equals + 1);
    const Json parsed = parse_json(value);
    json["set"][setting.substr(0, equals)] = parsed.is_discarded() ? Json(value) : parsed;
  }
  if (job.feedrate) {
    json["feedrate_mm_per_min"] = rounded(units::mm_per_min_from_mm_per_s(*job.feedrate));
  }
  json["hal"] = name_of(job.hal);
  for (const runtime::OverrideChange& change : job.overrides) {
    json["overrides"].push_back({change.time, change.percent});
  }
  if (job.trace == results::TraceFiles::kCsv) {
    json["trace"] = true;
  } else if (job.trace != results::TraceFiles::kNone) {
    json["trace"] = results::kTraceFilesNames[static_cast<std::size_t>(job.trace)];
  }
  return twin::to_line(json);
}

}  // namespace twin::studies::batch
