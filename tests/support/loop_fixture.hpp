#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>

#include "config/machine_file.hpp"
#include "hal/mujoco/mujoco_machine.hpp"
#include "runtime/run.hpp"
#include "tests/support/program_text.hpp"
#include "tests/support/temp_folder.hpp"

namespace twin::test {

/// Runs whole programs, with files of the repository.
class LoopTest : public ::testing::Test {
 protected:
  static config::MachineFile machine(const std::string& name = "xy_table.toml") {
    auto read = config::read_machine_file(std::string(TWIN_SOURCE_DIR "/mjcf/") + name);
    EXPECT_TRUE(read) << (read ? "" : to_string(read.error()));
    return read.value_or(config::MachineFile());
  }

  static std::filesystem::path program(const std::string& name) {
    return std::string(TWIN_SOURCE_DIR "/nc_programs/") + name;
  }

  results::Summary plan(const std::filesystem::path& nc,
                        std::optional<double> feedrate = std::nullopt) const {
    return execute(nc, machine(), nullptr, feedrate);
  }

  results::Summary run(const std::filesystem::path& nc, const std::string& machine_name,
                       std::optional<double> feedrate = std::nullopt) const {
    const config::MachineFile file = machine(machine_name);
    hal::mujoco::MujocoMachine table(file.table);
    return execute(nc, file, &table, feedrate);
  }

  results::Summary execute(const std::filesystem::path& nc, const config::MachineFile& file,
                           hal::Machine* hal, std::optional<double> feedrate) const {
    runtime::RunRequest request;
    request.program = text_of(nc);
    request.machine = file;
    request.hal = hal;
    request.feedrate = feedrate;
    request.directory = folder / "out";
    auto result = runtime::run_program(request);
    EXPECT_TRUE(result) << (result ? "" : to_string(result.error()));
    if (!result) {
      return {};
    }
    EXPECT_FALSE(result->failure) << to_string(*result->failure);
    return result->summary;
  }

  TempFolder folder;
};

}  // namespace twin::test
