#include "studies/identify/set_points.hpp"

#include <deque>
#include <utility>

#include "gcode/reader.hpp"
#include "motion/interpolator/interpolator.hpp"
#include "runtime/planning.hpp"

namespace twin::studies::identify {
namespace {

/// Planned segments, one after the other.
class PlannedList final : public motion::SegmentSource {
 public:
  void push(feedrate::PlannedSegment&& segment) { segments_.push_back(std::move(segment)); }
  const feedrate::PlannedSegment* next() noexcept override {
    return next_ < segments_.size() ? &segments_[next_++] : nullptr;
  }
  void release(const feedrate::PlannedSegment* /*segment*/) noexcept override {}
  bool is_finished() const noexcept override { return next_ == segments_.size(); }

 private:
  std::deque<feedrate::PlannedSegment> segments_;
  std::size_t next_ = 0;
};

}  // namespace

Expected<std::vector<motion::SetPoint>> plan_set_points(const std::filesystem::path& program,
                                                        const config::MachineFile& machine,
                                                        std::optional<double> feedrate) {
  gcode::ReaderOptions options;
  options.feedrate = feedrate;
  TWIN_TRY(auto reader, gcode::Reader::open(program.string(), options));
  PlannedList list;
  TWIN_CHECK(runtime::plan_program(reader, machine, [&](feedrate::PlannedSegment&& planned) {
    list.push(std::move(planned));
    return true;
  }));
  motion::Interpolator interpolator(list, machine.period, machine.interpolation);
  std::vector<motion::SetPoint> points;
  motion::SetPoint point;
  while (interpolator.step(point) == motion::Status::kMoving) {
    points.push_back(point);
  }
  return points;
}

}  // namespace twin::studies::identify
