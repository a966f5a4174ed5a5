#include "library/inside.hpp"

namespace twin {
namespace {

std::array<double, 3> array_of(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

Interpolator::Interpolator(const Program& program, const Settings& settings)
    : data_(std::make_unique<Data>()) {
  const auto& from = Inside::of(program);
  const config::MachineFile& machine = Inside::of(settings);
  data_->points = runtime::SetPoints::open(from.source, machine, from.feedrate);
  data_->period = machine.period;
}

Interpolator::Interpolator(Interpolator&&) noexcept = default;
Interpolator& Interpolator::operator=(Interpolator&&) noexcept = default;
Interpolator::~Interpolator() = default;

std::optional<SetPoint> Interpolator::next() {
  const double time = data_->points->time();
  motion::SetPoint point;
  if (!data_->points->next(point)) {
    if (const auto& error = data_->points->error()) {
      throw Failure(*error);
    }
    return std::nullopt;
  }
  return SetPoint{.time = time,
                  .position = array_of(point.position),
                  .velocity = array_of(point.velocity),
                  .acceleration = array_of(point.acceleration),
                  .feedrate = point.feedrate,
                  .segment = point.segment,
                  .line = point.line};
}

double Interpolator::period() const noexcept { return data_->period; }
void Interpolator::set_override(double percent) { data_->points->set_override(percent); }
void Interpolator::hold() { data_->points->hold(true); }
void Interpolator::resume() { data_->points->hold(false); }

}  // namespace twin
