#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "gcode/program_text.hpp"
#include "gcode/reader_options.hpp"
#include "pictures/figure/paper.hpp"

/// Figures and video, made from the trace that a run has left in a folder.
namespace twin::session {

/// What is in the trace of a folder.
enum class TraceKind {
  kRun,   ///< a machine has moved
  kPlan,  ///< there are set points alone
};

/// What summary.json says of the trace beside it.
struct TraceOrigin {
  std::string program;         ///< file name of the NC program
  std::string program_sha256;  ///< of its bytes
  TraceKind kind = TraceKind::kRun;
  bool is_partial = false;               ///< the run ended early
  std::filesystem::path trace;           ///< file of the trace
  std::string command;                   ///< command line of the run; may be empty
  std::string summary;                   ///< text of the summary
  gcode::ReaderOptions reading{};        ///< how the program was read, by the summary's settings
  std::optional<double> machining_time;  ///< as the summary has it [s]
};

/// Reads the summary in the folder of a run. A run that ended early, or was killed, is the one that
/// counts where its files are newer than those of a whole one.
Expected<TraceOrigin> read_origin(const std::filesystem::path& folder);

/// What the figures of a folder are drawn from.
struct FigureRequest {
  std::filesystem::path folder;  ///< holds the trace; the figures go to its folder plots
  std::optional<gcode::ProgramText> program;  ///< NC program; none: its path is not drawn
  std::string title;                          ///< above each figure
  TraceKind kind = TraceKind::kRun;
  std::string trace = "trace.csv";  ///< name of the trace
  gcode::ReaderOptions reading{};   ///< how the program is read
  pictures::Paper paper = pictures::Paper::kNone;
};

/// Draws the figures of a trace.
Expected<void> draw_figures(const FigureRequest& request);

/// What the video of a folder is rendered from.
struct VideoRequest {
  std::filesystem::path folder;            ///< holds the trace; video.mp4 goes beside it
  std::filesystem::path model;             ///< MJCF file of the table; scene.xml is beside it
  std::string title;                       ///< first line of the read-out
  std::string camera = "iso";              ///< camera of the scene: "iso", "top" or "follow"
  std::function<void(double)> progress{};  ///< gets the done share, 0 to 1; may be empty
  std::string trace = "trace.csv";         ///< name of the trace
};

/// Renders the video of a trace.
Expected<void> render_video(const VideoRequest& request);

}  // namespace twin::session
