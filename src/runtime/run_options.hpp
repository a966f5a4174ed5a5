#pragma once

#include <filesystem>
#include <optional>

#include "config/machine_file.hpp"
#include "gcode/reader.hpp"
#include "runtime/feed_control.hpp"
#include "runtime/motion.hpp"
#include "runtime/pace.hpp"
#include "runtime/recorder.hpp"
#include "runtime/run.hpp"

namespace twin::runtime {

/// How programs are read for a machine.
///
/// @param feedrate  in place of the F words, if any [mm/s]
gcode::ReaderOptions reader_options(const config::MachineFile& machine,
                                    const std::optional<double>& feedrate);

/// What the parts of a run are told of its request.
gcode::ReaderOptions reader_options(const RunRequest& request);
/// @param first_percent  override of the first plan [%]
FeedControl::Options feed_options(const RunRequest& request, double first_percent);
MotionOptions motion_options(const RunRequest& request);
WallClockPace::Options wall_clock_options(const RunRequest& request);
Recorder::Options recorder_options(const RunRequest& request);

/// Makes the folder of the results, and that of the plots in it.
Expected<void> make_folders(const std::filesystem::path& directory);

}  // namespace twin::runtime
