#include "twin/report.hpp"

#include <filesystem>

#include "config/find_file.hpp"
#include "library/inside.hpp"
#include "session/report.hpp"

namespace twin {

void write_report(const std::vector<std::string>& folders, const std::string& file,
                  const std::vector<Program>& programs) {
  const auto find =
      [&programs](const session::TraceOrigin& origin) -> std::optional<gcode::ProgramText> {
    for (const Program& program : programs) {
      const gcode::ProgramText& text = Inside::of(program).source;
      if (text.sha256() == origin.program_sha256) {
        return text;
      }
    }
    const auto found = config::find_program(origin.program).and_then([](const auto& name) {
      return gcode::ProgramText::read(name);
    });
    return found && found->sha256() == origin.program_sha256 ? std::optional(*found) : std::nullopt;
  };
  const std::vector<std::filesystem::path> paths(folders.begin(), folders.end());
  check(session::write_report(paths, find, file));
}

}  // namespace twin
