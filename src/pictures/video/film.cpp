#include "pictures/video/film.hpp"

#include <algorithm>
#include <utility>

#include "hal/mujoco/table_pose.hpp"

namespace twin::pictures::video {
namespace {

constexpr Colour kPlate{247, 247, 242};
constexpr Colour kPaper{250, 250, 247};
constexpr double kPlateLine = 9.0;     // [texels] on the plate
constexpr double kInsetLine = 2.2;     // [pixels]
constexpr double kInsetMargin = 10.0;  // [pixels]

Vec2 on_plate(const Vec2& p) {
  return {hal::mujoco::drawing_column(p.x()), hal::mujoco::drawing_row(p.y())};
}

/// The bounding box of the drawing, fitted into the inset.
PenTrail make_inset(const Survey& survey, ColourScale scale, int frame_width, int frame_height) {
  const Vec2 extent = survey.high - survey.low;
  const Rectangle size = inset_size(frame_width, frame_height, extent);
  const Vec2 room(size.width - 2.0 * kInsetMargin, size.height - 2.0 * kInsetMargin);
  const double pixels_per_mm = (room.array() / extent.array().max(1e-3)).minCoeff();
  const Vec2 middle = (survey.low + survey.high) / 2.0;
  const Vec2 centre(size.width / 2.0, size.height / 2.0);
  return {Canvas(size.width, size.height, kPaper, kInsetLine),
          [=](const Vec2& p) -> Vec2 {
            const Vec2 from_middle = pixels_per_mm * (p - middle);
            return {centre.x() + from_middle.x(), centre.y() - from_middle.y()};
          },
          scale, survey.pen_up};
}

}  // namespace

Film::Film(const Survey& survey, TraceRows&& rows, TableScene&& scene, int width, int height)
    : survey_(survey),
      scale_(survey.largest_error_um),
      rows_(std::move(rows)),
      scene_(std::move(scene)),
      plate_(Canvas(hal::mujoco::kDrawingTexels, hal::mujoco::kDrawingTexels, kPlate, kPlateLine),
             on_plate, scale_, survey.pen_up),
      inset_(make_inset(survey, scale_, width, height)),
      width_(width),
      height_(height) {}

Expected<Film> Film::create(const std::filesystem::path& trace_csv,
                            const std::filesystem::path& scene_xml, const std::string& camera,
                            int width, int height, int samples) {
  TWIN_TRY(const Survey survey, survey_trace(trace_csv));
  TWIN_TRY(TraceRows rows, TraceRows::open(trace_csv));
  TWIN_TRY(TableScene scene, TableScene::create(scene_xml, camera, width, height, samples));
  return Film(survey, std::move(rows), std::move(scene), width, height);
}

Overlay Film::make_overlay(const std::string& title) {
  return {Font::make(scene_), scale_, title, survey_.duration, survey_.has_error};
}

Expected<void> Film::play_until(double t) {
  while (has_next_ && (is_first_ || next_.t <= t)) {
    if (!is_first_) {
      shown_ = next_;
      plate_.advance(shown_);
      inset_.advance(shown_);
    }
    TWIN_TRY(has_next_, rows_.next(next_));
    if (std::exchange(is_first_, false) && has_next_) {
      shown_ = next_;
    }
  }
  return {};
}

Expected<Shot> Film::shoot(double t) {
  TWIN_CHECK(play_until(t));
  scene_.move_to(shown_.position);
  scene_.set_drawing(plate_.canvas().image(), plate_.canvas().take_changed());
  Shot shot{Image(width_, height_),
            {shown_, inset_.canvas().image(), inset_.place(shown_.position.head<2>())}};
  scene_.render(shot.frame);
  return shot;
}

}  // namespace twin::pictures::video
