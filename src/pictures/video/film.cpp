#include "pictures/video/film.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/units.hpp"
#include "hal/mujoco/table_pose.hpp"

namespace twin::pictures::video {
namespace {

constexpr const char* kFollow = "follow";
constexpr Colour kPlate{247, 247, 242};
constexpr Colour kPaper{250, 250, 247};
constexpr Colour kTarget{178, 182, 190};
constexpr double kLine = 4.5;            // of the pen [pixels of the frame]
constexpr double kTargetPart = 0.45;     // of that
constexpr double kDrawingLevel = 0.548;  // height of the drawing in the world [m]
constexpr double kInsetLine = 2.2;       // [pixels]
constexpr double kInsetMargin = 10.0;    // [pixels]

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

Film::View Film::choose_view(const Survey& survey, const TableScene& scene, bool follows,
                             int height) {
  const Vec2 extent = units::m_from_mm(1.0) * (survey.high - survey.low);
  Framed box;
  if (follows) {
    box.middle << units::m_from_mm(1.0) * (survey.low + survey.high) / 2.0, kDrawingLevel;
    box.half = extent / 2.0;
  } else {
    // The pen stands still, and the plate brings every place of the drawing under it.
    box.middle = {0.0, 0.0, kDrawingLevel};
    box.half = extent;
  }
  const Lens lens = scene.lens();
  View view;
  view.camera = stand(lens, box);
  view.follows = follows;
  const double texels = kLine * hal::mujoco::kTexelsPerMm /
                        pixels_per_mm(lens, box, view.camera, height - strip_height(height));
  view.line = std::clamp(texels, 2.0, 12.0);
  return view;
}

Film::Film(Survey&& survey, TraceRows&& rows, TableScene&& scene, const View& view, int width,
           int height)
    : survey_(std::move(survey)),
      scale_(survey_.largest_rms_um),
      rows_(std::move(rows)),
      scene_(std::move(scene)),
      view_(view),
      plate_(Canvas(hal::mujoco::kDrawingTexels, hal::mujoco::kDrawingTexels, kPlate, view.line),
             on_plate, scale_, survey_.pen_up),
      inset_(make_inset(survey_, scale_, width, height)),
      width_(width),
      height_(height) {}

Expected<Film> Film::create(const std::filesystem::path& trace_csv,
                            const std::filesystem::path& scene_xml, const std::string& camera,
                            int width, int height, int samples) {
  const bool follows = camera == kFollow;
  TWIN_TRY(Survey survey, survey_trace(trace_csv));
  TWIN_TRY(TraceRows rows, TraceRows::open(trace_csv));
  TWIN_TRY(TableScene scene,
           TableScene::create(scene_xml, follows ? hal::mujoco::kCameraIso : camera, width,
                              height - strip_height(height), samples));
  const View view = choose_view(survey, scene, follows, height);
  Film film(std::move(survey), std::move(rows), std::move(scene), view, width, height);
  TWIN_CHECK(film.draw_target(trace_csv));
  film.scene_.stand_camera_at(view.camera);
  return film;
}

Expected<void> Film::draw_target(const std::filesystem::path& trace_csv) {
  TWIN_TRY(TraceRows rows, TraceRows::open(trace_csv));
  constexpr double shortest = 0.5;  // [texels]
  Canvas& canvas = plate_.canvas();
  canvas.set_line_width(std::max(kTargetPart * view_.line, 1.0));
  std::optional<Vec2> last;
  for (TraceRow row;;) {
    TWIN_TRY(const bool got, rows.next(row));
    if (!got) {
      break;
    }
    if (row.position.z() > survey_.pen_up) {
      last.reset();
      continue;
    }
    const Vec2 here = on_plate(row.commanded);
    if (!last || (here - *last).norm() >= shortest) {
      canvas.line(last.value_or(here), here, kTarget);
      last = here;
    }
  }
  canvas.set_line_width(view_.line);
  return {};
}

Overlay Film::make_overlay(const std::string& title) {
  return {Font::make(scene_),
          scale_,
          Strip(survey_.history, survey_.duration, round_up(survey_.largest_error_um),
                survey_.has_error, width_, strip_height(height_)),
          title,
          survey_.duration,
          survey_.has_error};
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
  if (view_.follows) {
    scene_.stand_camera_at(view_.camera - units::m_from_mm(1.0) *
                                              Vec3(shown_.position.x(), shown_.position.y(), 0.0));
  }
  scene_.move_to(shown_.position);
  scene_.set_drawing(plate_.canvas().image(), plate_.canvas().take_changed());
  Shot shot{Image(width_, height_),
            {shown_, view_.follows ? Image() : inset_.canvas().image(),
             inset_.place(shown_.position.head<2>())}};
  scene_.render(shot.frame);
  return shot;
}

}  // namespace twin::pictures::video
