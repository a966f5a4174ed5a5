#include <vector>

#include "config/machine_file.hpp"
#include "tests/fuzz/target.hpp"

namespace twin::fuzz {
namespace machine_file_target {

constexpr std::string_view kSet = "--set ";

/// Lines that begin with `--set ` are overrides, all others are the machine file.
void split(std::string_view text, std::string& file, std::vector<std::string>& overrides) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size() - 1);
    const std::string_view line = text.substr(0, end + 1);
    text.remove_prefix(end + 1);
    if (line.starts_with(kSet)) {
      const std::size_t length = line.size() - kSet.size() - (line.back() == '\n' ? 1 : 0);
      overrides.emplace_back(line.substr(kSet.size(), length));
    } else {
      file += line;
    }
  }
}

/// A file is refused with a message, or it is written and read back to the same settings.
void run(Bytes bytes) {
  std::string file;
  std::vector<std::string> overrides;
  split(text_of(bytes), file, overrides);
  const auto machine = config::parse_machine_file(file, "/fuzz/fuzz.toml", overrides);
  if (!machine) {
    promise(!machine.error().message.empty(), "an error without a message");
    return;
  }
  const std::string written = config::to_toml(*machine);
  const auto again = config::parse_machine_file(written, "/fuzz/fuzz.toml");
  promise(again.has_value(),
          "what was written cannot be read: " + (again ? std::string() : to_string(again.error())));
  promise(config::to_toml(*again) == written, "what was written is read as something else");
}

}  // namespace machine_file_target

const Target kMachineFile{"machine_file", machine_file_target::run};

}  // namespace twin::fuzz
