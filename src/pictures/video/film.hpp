#pragma once

#include <filesystem>
#include <string>

#include "core/error.hpp"
#include "pictures/video/canvas.hpp"
#include "pictures/video/overlay.hpp"
#include "pictures/video/survey.hpp"
#include "pictures/video/table_scene.hpp"
#include "pictures/video/trace_rows.hpp"

namespace twin::pictures::video {

/// A frame as the scene gives it, and what is to be written over it.
struct Shot {
  Image frame;
  Readout readout;
};

/// Plays a trace in the scene, frame after frame. All calls from one thread.
class Film {
 public:
  /// @param camera   of the scene; "follow" is the camera iso, moved along with the plate
  /// @param samples  per pixel and edge: 0 or 4
  static Expected<Film> create(const std::filesystem::path& trace_csv,
                               const std::filesystem::path& scene_xml, const std::string& camera,
                               int width, int height, int samples);

  double duration() const noexcept { return survey_.duration; }  ///< machining time [s]
  /// The overlay that belongs to the shots; it may be used in another thread.
  Overlay make_overlay(const std::string& title);

  /// The picture at a time. @param t  [s], not before that of the last shot
  Expected<Shot> shoot(double t);

 private:
  /// How the camera stands, and how wide the pen's line is.
  struct View {
    Vec3 camera = Vec3::Zero();  // place [m]; of a camera that follows: with the plate at (0, 0)
    bool follows = false;
    double line = 9.0;  // [texels]
  };
  static View choose_view(const Survey& survey, const TableScene& scene, bool follows, int height);

  Film(Survey&& survey, TraceRows&& rows, TableScene&& scene, const View& view, int width,
       int height);
  Expected<void> draw_target(const std::filesystem::path& trace_csv);
  Expected<void> play_until(double t);

  Survey survey_;
  ColourScale scale_;
  TraceRows rows_;
  TableScene scene_;
  View view_;
  PenTrail plate_;
  PenTrail inset_;
  TraceRow shown_;  // newest row that is not later than the last shot
  TraceRow next_;   // the row after it
  bool has_next_ = true;
  bool is_first_ = true;
  int width_;
  int height_;
};

}  // namespace twin::pictures::video
