#include "studies/batch/sweep_file.hpp"

#include <fmt/format.h>

#include <toml++/toml.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "config/nearest_name.hpp"
#include "core/atomic_file.hpp"
#include "core/json.hpp"
#include "core/units.hpp"
#include "studies/batch/job_file.hpp"

namespace twin::studies::batch {
namespace {

constexpr std::int64_t kMostPoints = 1'000'000'000'000;

/// Levels of an identify.json below which nothing is looked for; twin identify writes four.
constexpr int kMostLevels = 16;

/// Every parameter below a value of an identify.json that has a deviation, and was found.
void collect_identified(const Json& json, std::vector<DrawnKey>& drawn, int level = 0) {
  const std::string* const verdict = text_in(json, "verdict");
  const std::string* const name = text_in(json, "key");
  const auto sigma = number_in(json, "sigma");
  const auto mean = number_in(json, "value");
  if (verdict != nullptr && name != nullptr && sigma && mean) {
    if ((*verdict == "identified" || *verdict == "uncertain") && *sigma > 0.0) {
      drawn.push_back({*name, *mean, *sigma});
    }
    return;
  }
  if (json.is_structured() && level < kMostLevels) {
    for (const auto& [key, value] : json.items()) {
      if (key != "derived") {
        collect_identified(value, drawn, level + 1);
      }
    }
  }
}

/// Takes a sweep out of a table of TOML, and says where it is wrong.
class SweepReader {
 public:
  explicit SweepReader(const std::filesystem::path& file) : file_(file) {}

  Expected<Sweep> read(const toml::table& table) {
    for (const auto& [key, node] : table) {
      TWIN_CHECK(take(std::string(key.str()), node));
    }
    const bool has_program = !sweep_.base.program.empty() || has_listed("program");
    if (!has_program) {
      return wrong(table, "there is no program; expected program = \"NAME.nc\" or a list");
    }
    return sweep_;
  }

 private:
  tl::unexpected<Error> wrong(const toml::node& node, std::string message) const {
    const auto& place = node.source().begin;
    return tl::unexpected(Error{ErrorCode::kUsage, std::move(message), file_.string(),
                                static_cast<int>(place.line), static_cast<int>(place.column)});
  }

  bool has_listed(std::string_view key) const {
    return std::ranges::any_of(sweep_.grid, [&](const ListedKey& k) { return k.key == key; });
  }

  Expected<void> take(const std::string& key, const toml::node& node) {
    if (key == "program" || key == "feedrate_mm_per_min") {
      return take_listed(key, node);
    }
    if (key == "machine" || key == "hal" || key == "trace") {
      return take_common(key, node);
    }
    const toml::table* const section = node.as_table();
    if (section != nullptr && key == "set") {
      return take_set(*section);
    }
    if (section != nullptr && key == "grid") {
      return take_grid(*section);
    }
    if (section != nullptr && key == "latin_hypercube") {
      return take_drawn(*section, "from", "to", sweep_.hypercube, sweep_.hypercube_count,
                        sweep_.hypercube_seed);
    }
    if (section != nullptr && key == "monte_carlo") {
      return take_drawn(*section, "mean", "sigma", sweep_.normal, sweep_.normal_count,
                        sweep_.normal_seed);
    }
    const std::array<std::string, 9> keys{
        "program", "feedrate_mm_per_min", "machine",    "hal", "trace", "set",
        "grid",    "latin_hypercube",     "monte_carlo"};
    return wrong(node, fmt::format("unknown key {}{}", key, config::did_you_mean(key, keys)));
  }

  /// program and feedrate: one value for all, or a list that is part of the grid.
  Expected<void> take_listed(const std::string& key, const toml::node& node) {
    ListedKey listed{key, {}};
    TWIN_TRY(listed.values, values_of(node));
    for (const std::string& value : listed.values) {
      if (key != "program" && !(std::strtod(value.c_str(), nullptr) > 0.0)) {
        return wrong(node, fmt::format("{} is {}; expected a number above 0", key, value));
      }
    }
    sweep_.grid.insert(sweep_.grid.begin() + (key == "program" ? 0 : has_listed("program")),
                       std::move(listed));
    return {};
  }

  Expected<void> take_common(const std::string& key, const toml::node& node) {
    if (key == "trace") {
      const auto flag = node.value_exact<bool>();
      const auto name = node.value_exact<std::string>();
      const auto trace =
          flag   ? std::optional(*flag ? results::TraceFiles::kCsv : results::TraceFiles::kNone)
          : name ? results::trace_files_of(*name)
                 : std::nullopt;
      if (!trace) {
        return wrong(node, "trace is true, false, \"csv\", \"hdf5\", \"both\" or \"none\"");
      }
      sweep_.base.trace = *trace;
      return {};
    }
    const auto text = node.value_exact<std::string>();
    if (!text || text->empty()) {
      return wrong(node, key + " is a name in quotes");
    }
    if (key == "machine") {
      sweep_.base.machine = *text;
      return {};
    }
    for (const JobMachine machine : {JobMachine::kTable, JobMachine::kIdeal, JobMachine::kNone}) {
      if (*text == name_of(machine)) {
        sweep_.base.hal = machine;
        return {};
      }
    }
    return wrong(node, fmt::format("hal is \"{}\"; expected mujoco, ideal or none", *text));
  }

  Expected<void> take_set(const toml::table& section) {
    for (const auto& [key, node] : section) {
      TWIN_TRY(const std::string value, value_of(node));
      sweep_.base.settings.push_back(std::string(key.str()) + "=" + value);
    }
    return {};
  }

  Expected<void> take_grid(const toml::table& section) {
    for (const auto& [key, node] : section) {
      ListedKey listed{std::string(key.str()), {}};
      if (const toml::table* const range = node.as_table()) {
        TWIN_TRY(listed.values, steps_of(*range));
      } else {
        TWIN_TRY(listed.values, values_of(node));
      }
      sweep_.grid.push_back(std::move(listed));
    }
    return {};
  }

  Expected<void> take_drawn(const toml::table& section, const char* first, const char* second,
                            std::vector<DrawnKey>& drawn, std::size_t& count, std::uint64_t& seed) {
    const auto points = section["count"].value_exact<std::int64_t>();
    if (!points || *points < 1 || *points > kMostPoints) {
      return wrong(section, "count is missing, or is no whole number of 1 and more");
    }
    count = static_cast<std::size_t>(*points);
    for (const auto& [name, node] : section) {
      const std::string key(name.str());
      if (key == "count") {
        continue;
      }
      if (key == "seed") {
        const auto value = node.value_exact<std::int64_t>();
        if (!value || *value < 0) {
          return wrong(node, "seed is no whole number of 0 and more");
        }
        seed = static_cast<std::uint64_t>(*value);
        continue;
      }
      if (key == "identified" && std::string_view(first) == "mean") {
        TWIN_CHECK(take_identified(node, drawn));
        continue;
      }
      const toml::table* const range = node.as_table();
      const auto from = range == nullptr ? std::nullopt : (*range)[first].value<double>();
      const auto to = range == nullptr ? std::nullopt : (*range)[second].value<double>();
      if (!from || !to || !std::isfinite(*from) || !std::isfinite(*to) || range->size() != 2) {
        return wrong(node, fmt::format("{} is no range; expected {{ {} = NUMBER, {} = NUMBER }}",
                                       key, first, second));
      }
      drawn.push_back({key, *from, *to});
    }
    if (drawn.empty()) {
      return wrong(section, "no setting is drawn here");
    }
    return {};
  }

  /// The parameters that `twin identify` has found, with their deviations, from its identify.json. Its
  /// name counts from the folder of the sweep's file.
  Expected<void> take_identified(const toml::node& node, std::vector<DrawnKey>& drawn) const {
    const auto name = node.value_exact<std::string>();
    if (!name || name->empty()) {
      return wrong(node, "identified is the name of an identify.json in quotes");
    }
    const std::filesystem::path file = file_.parent_path() / *name;
    TWIN_TRY(const std::string text, read_whole_file(file));
    const std::size_t before = drawn.size();
    collect_identified(parse_json(text), drawn);
    return drawn.size() > before
               ? Expected<void>{}
               : wrong(node,
                       fmt::format("{} has no identified parameter with a deviation; expected "
                                   "the identify.json of twin identify",
                                   file.string()));
  }

  /// { from, to, count }: evenly spaced numbers, both ends among them.
  Expected<std::vector<std::string>> steps_of(const toml::table& range) const {
    const auto from = range["from"].value<double>();
    const auto to = range["to"].value<double>();
    const auto count = range["count"].value_exact<std::int64_t>();
    if (!from || !to || !count || *count < 2 || *count > static_cast<std::int64_t>(kMostJobs) ||
        range.size() != 3 || !std::isfinite(*from) || !std::isfinite(*to)) {
      return wrong(range, "expected { from = NUMBER, to = NUMBER, count = 2 OR MORE }");
    }
    std::vector<std::string> values;
    for (std::int64_t i = 0; i < *count; ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(*count - 1);
      values.push_back(fmt::format("{:.9g}", *from + share * (*to - *from)));
    }
    return values;
  }

  /// A list of values, or one.
  Expected<std::vector<std::string>> values_of(const toml::node& node) const {
    std::vector<std::string> values;
    const toml::array* const list = node.as_array();
    if (list == nullptr) {
      TWIN_TRY(std::string value, value_of(node));
      values.push_back(std::move(value));
      return values;
    }
    for (const toml::node& item : *list) {
      TWIN_TRY(std::string value, value_of(item));
      values.push_back(std::move(value));
    }
    if (values.empty()) {
      return wrong(node, "an empty list; expected values");
    }
    return values;
  }

  /// A value as --set takes it.
  Expected<std::string> value_of(const toml::node& node) const {
    if (const auto text = node.value_exact<std::string>()) {
      return *text;
    }
    if (const auto flag = node.value_exact<bool>()) {
      return std::string(*flag ? "true" : "false");
    }
    if (const auto number = node.value<double>(); number && std::isfinite(*number)) {
      return fmt::format("{}", *number);
    }
    if (const toml::array* const list = node.as_array()) {
      std::string text = "[";
      for (const toml::node& item : *list) {
        const auto number = item.value<double>();
        if (!number) {
          return wrong(item, "expected a number");
        }
        text += fmt::format("{}{}", text.size() > 1 ? ", " : "", *number);
      }
      return text + "]";
    }
    return wrong(node, "expected a number, a text, true or false, or a list of numbers");
  }

  const std::filesystem::path& file_;
  Sweep sweep_;
};

}  // namespace

Expected<Sweep> parse_sweep(std::string_view text, const std::filesystem::path& file) {
  try {
    return SweepReader(file).read(toml::parse(text));
  } catch (const toml::parse_error& error) {
    const auto& place = error.source().begin;
    return tl::unexpected(Error{ErrorCode::kUsage, std::string(error.description()), file.string(),
                                static_cast<int>(place.line), static_cast<int>(place.column)});
  }
}

Expected<Sweep> read_sweep(const std::filesystem::path& file) {
  TWIN_TRY(const std::string text, read_whole_file(file));
  return parse_sweep(text, file);
}

}  // namespace twin::studies::batch
