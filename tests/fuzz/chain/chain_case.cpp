#include "tests/fuzz/chain/chain_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

namespace twin::fuzz {
namespace {

/// An operation before its time is known in seconds.
struct Wish {
  double place;    ///< share of the reference time
  double percent;  ///< 0 holds
  double length;   ///< of a hold; 0: until the end [periods]
};

std::vector<Wish> make_wishes(ByteSource& bytes) {
  std::vector<Wish> wishes(bytes.happens(128) ? bytes.choice(5) : 0);
  for (Wish& wish : wishes) {
    wish.place = bytes.uniform(0.0, 0.6);
    const unsigned kind = bytes.byte();
    wish.percent = kind < 128 ? 0.0 : kind < 192 ? 20.0 + (kind - 128) * 180.0 / 63.0 : 100.0;
    wish.length = kind < 8 ? 0.0 : static_cast<double>(kind);
  }
  std::sort(wishes.begin(), wishes.end(),
            [](const Wish& a, const Wish& b) { return a.place < b.place; });
  return wishes;
}

/// Wishes as a schedule: a hold is over after its length, at the override before it.
std::vector<runtime::OverrideChange> schedule_of(const std::vector<Wish>& wishes, double duration,
                                                 double period) {
  std::vector<runtime::OverrideChange> changes;
  double percent = 100.0;
  double time = 0.0;
  for (const Wish& wish : wishes) {
    time = std::max(time, wish.place * duration);
    changes.push_back({time, wish.percent});
    if (wish.percent > 0.0) {
      percent = wish.percent;
      continue;
    }
    if (wish.length == 0.0) {
      break;
    }
    time += wish.length * period;
    changes.push_back({time, percent});
  }
  return changes;
}

std::string text_of(const SettingValue& value) {
  struct Writer {
    std::string operator()(bool v) const { return v ? "true" : "false"; }
    std::string operator()(std::int64_t v) const { return std::to_string(v); }
    std::string operator()(double v) const { return fmt::format("{:.17g}", v); }
    std::string operator()(const std::string& v) const { return v; }
    std::string operator()(const std::vector<double>& v) const {
      std::string text;
      for (const double x : v) {
        text += fmt::format("{}{:.17g}", text.empty() ? "" : ",", x);
      }
      return "[" + text + "]";
    }
  };
  return std::visit(Writer{}, value);
}

}  // namespace

Case make_case(Bytes bytes) {
  ByteSource source(bytes);
  Case made;
  made.machine = make_settings(source);
  made.cuts = {source.used()};
  const std::vector<Wish> wishes = make_wishes(source);
  made.program = make_program(source, made.machine);
  made.cuts.insert(made.cuts.end(), made.program.cuts.begin(), made.program.cuts.end());
  for (const Piece& piece : made.program.pieces) {
    made.reference_time += fuzz::reference_time(piece, made.machine);
  }
  made.operations = schedule_of(wishes, made.reference_time, made.machine.period);
  return made;
}

std::string show(const Case& made) {
  std::string command = "twin plan THIS.nc";
  const auto settings = config::settings_of(made.machine);
  const auto usual = config::settings_of(config::MachineFile{});
  for (std::size_t i = 0; i < settings.size(); ++i) {
    const Setting& setting = settings[i];
    const bool is_said = setting.section == "limits" || setting.section == "planning" ||
                         setting.section == "path" || setting.section == "interpolator";
    if (is_said && setting.value != usual[i].value) {
      command +=
          fmt::format(" --set '{}.{}={}'", setting.section, setting.key, text_of(setting.value));
    }
  }
  for (std::size_t i = 0; i < made.operations.size(); ++i) {
    command += fmt::format("{}{:.9g}:{:.9g}", i == 0 ? " --override " : ",",
                           made.operations[i].time, made.operations[i].percent);
  }
  return fmt::format("; {}\n{}", command, made.program.text);
}

}  // namespace twin::fuzz
