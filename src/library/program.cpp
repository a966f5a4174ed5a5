#include <cmath>
#include <filesystem>

#include "config/find_file.hpp"
#include "core/atomic_file.hpp"
#include "library/inside.hpp"
#include "runtime/program_check.hpp"
#include "runtime/run_options.hpp"

namespace twin {

Expected<void> make_folder(const std::filesystem::path& folder) {
  std::error_code code;
  std::filesystem::create_directories(folder, code);
  return code ? file_error(folder, "make this folder", code.value()) : Expected<void>{};
}

Program::Program(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

Program Program::from_file(const std::string& name) {
  return Program(std::make_shared<Data>(Data{
      value_of(gcode::ProgramText::read(value_of(config::find_program(name)))), std::nullopt}));
}

Program Program::from_text(std::string text, std::string name) {
  return Program(std::make_shared<Data>(
      Data{gcode::ProgramText::from_text(std::move(text), std::move(name)), std::nullopt}));
}

Program Program::with_feedrate(double feedrate) const {
  if (!(feedrate > 0.0) || !std::isfinite(feedrate)) {
    throw Failure({ErrorCode::kUsage,
                   "the feedrate is " + std::to_string(feedrate) + " mm/s; it must be above 0",
                   {},
                   0,
                   0});
  }
  return Program(std::make_shared<Data>(Data{data_->source, feedrate}));
}

std::string Program::name() const { return data_->source.file().filename().string(); }

ProgramFigures Program::check(const Settings& settings, const std::atomic<bool>* stop) const {
  const config::MachineFile& machine = Inside::of(settings);
  const auto found = value_of(runtime::check_program(
      data_->source, runtime::reader_options(machine, data_->feedrate), machine.limits, stop));
  ProgramFigures figures{.blocks = found.blocks, .length = found.length};
  for (std::size_t i = 0; i < 3; ++i) {
    figures.box_min[i] = found.box_min[static_cast<Eigen::Index>(i)];
    figures.box_max[i] = found.box_max[static_cast<Eigen::Index>(i)];
  }
  return figures;
}

}  // namespace twin
