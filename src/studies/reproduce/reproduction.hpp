#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "hal/mujoco/table_params.hpp"
#include "studies/jobs/run_jobs.hpp"
#include "studies/reproduce/published.hpp"

namespace twin::studies::reproduce {

/// What is to be reproduced, and on which table.
struct Request {
  Published published;
  std::filesystem::path machine_file;
  std::vector<std::string> settings;  ///< section.key=value, for all rows
  int repeats = 10;                   ///< runs with other phases, for mean and deviation
  std::filesystem::path folder;       ///< exists; gets a folder with the trace of each single run
  studies::jobs::Options running;
};

/// Mean and standard deviation of a number over the repeats.
struct Spread {
  double mean = 0.0;
  double deviation = 0.0;  ///< of one run; 0 for a single repeat
};

/// Our answer to a published row. Numbers are in the order and the units of columns_of(table).
struct Answer {
  PublishedRow published;
  std::vector<double> single;    ///< with the phases of the machine file
  std::vector<Spread> repeats;   ///< empty where nothing was repeated
  results::Summary summary;      ///< of the single run
  config::MachineFile machine;   ///< of the single run
  std::filesystem::path folder;  ///< with its trace
};

/// All rows, run in one way.
struct Variant {
  std::string name;             ///< "as_published", "defaults"
  std::string title;            ///< for a heading
  std::vector<Answer> answers;  ///< in the order of the published rows
};

/// The paper's tables, answered twice: with the variants of the method that the paper describes
/// for each row, and with the defaults of this program.
struct Reproduction {
  std::string source;   ///< of the published numbers
  std::string machine;  ///< name of the machine file
  int repeats = 0;
  std::array<Variant, 2> variants;

  const Variant& as_published() const { return variants[0]; }
  const Variant& defaults() const { return variants[1]; }
};

/// Runs every row in both ways. Rows with the same program, interpolator, feedrate and settings are
/// run once.
Expected<Reproduction> reproduce(const Request& request);

/// The answer for a measured row: program, interpolator, feedrate. Null if there is none.
const Answer* find_answer(const Variant& variant, const std::string& program,
                          const std::string& interpolator, double feedrate_mm_per_min);

/// The table as another run of it would find it: encoders and hum elsewhere in their cycle.
///
/// With g the root of g^4 = g + 1, repeat k moves the phase of the X encoder by k / g, that of the
/// Y encoder by k / g^2 and the hum of both axes, which hang on one mains, by k / g^3 of a cycle.
/// These points fill the cube of phases evenly however many there are, a generalised golden-ratio
/// sequence. Repeat 0 is the table as it is.
hal::mujoco::TableParams with_phases_of_repeat(hal::mujoco::TableParams table, int repeat);

}  // namespace twin::studies::reproduce
