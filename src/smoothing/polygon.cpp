#include "smoothing/polygon.hpp"

namespace twin::smoothing {

void Polygon::start(const Vec3& at, double s) {
  vertices_.restart(0);
  vertices_.push_back({at, Vec3::Zero(), s, 0.0});
}

void Polygon::push(const Vec3& end) {
  const std::size_t i = last();
  Vertex& from = vertices_[i];
  const Vec3 way = end - from.at;
  const double length = way.norm();
  from.direction = way / length;
  if (i > first()) {
    from.turn = (from.direction - vertices_[i - 1].direction).norm();
  }
  const double s = from.s + length;
  vertices_.push_back({end, Vec3::Zero(), s, 0.0});
}

std::size_t Polygon::block_at(double s, std::size_t i, std::size_t lowest,
                              std::size_t highest) const noexcept {
  while (i < highest && vertices_[i + 1].s <= s) {
    ++i;
  }
  while (i > lowest && vertices_[i].s > s) {
    --i;
  }
  return i;
}

}  // namespace twin::smoothing
