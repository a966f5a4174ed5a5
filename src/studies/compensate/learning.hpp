#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "config/machine_file.hpp"
#include "core/error.hpp"
#include "gcode/program_text.hpp"
#include "motion/correction/correction_follower.hpp"
#include "studies/compensate/compensate.hpp"

namespace twin::studies::compensate {

/// A correction of one program on one machine, and what the model expects of it.
struct MadeCorrection {
  motion::Correction correction;
  Compensation compensation;

  /// "contour error of the model's table: max 16.9 -> 3.2 um, RMS 3.27 -> 0.29 um"
  std::string remark() const;
};

/// Plans a program with reserve and corrects it on the model of its machine file.
///
/// @param feedrate  replaces the program's F words [mm/s]
/// @returns an error where the model was never identified or the program cannot be planned
Expected<MadeCorrection> make_correction(const gcode::ProgramText& program,
                                         const config::MachineFile& machine,
                                         const std::optional<double>& feedrate,
                                         const CompensateOptions& options = {});

/// What measured runs have shown of the difference between machine and model.
///
/// A run with offsets o that measured y has the mismatch y - M(o), with the model's mean M over
/// phases. The mismatch is filtered without delay up to the frequency that the response is trusted
/// to, and below the mains hum, so that hum and encoder steps are not learnt; what is left of them
/// falls with the number of runs. Run n enters the mean with the weight 2 / (n + 1): later runs,
/// whose offsets are nearer to the last ones, count more.
struct Learnt {
  std::vector<Vec2> mismatch;  ///< (periods) [mm]
  int runs = 0;
};

/// Adds a measured run.
///
/// @param measured  positions by the encoders, one a period [mm]
/// @param offsets   that the run had [mm]
/// @returns an error if the run has not as many periods as the path, or is too short to learn from
Expected<void> add_run(const config::MachineFile& machine, const ContourPath& path,
                       std::span<const Vec2> measured, std::span<const Vec2> offsets,
                       Learnt& learnt);

/// Files of a folder in which a program's runs are learnt from: correction.csv, and learnt.csv with
/// the mismatch.
struct LearningFolder {
  std::filesystem::path folder;

  std::filesystem::path correction() const { return folder / "correction.csv"; }
  std::filesystem::path learnt() const { return folder / "learnt.csv"; }
};

Expected<void> write_learnt(const std::filesystem::path& file, const Learnt& learnt);
/// Reads what write_learnt() has written; nothing learnt where there is no file.
/// @param periods  that it must have
Expected<Learnt> read_learnt(const std::filesystem::path& file, std::size_t periods);

}  // namespace twin::studies::compensate
