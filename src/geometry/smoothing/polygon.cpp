#include "geometry/smoothing/polygon.hpp"

namespace twin::geometry {
namespace {

Vec3 minmod(const Vec3& a, const Vec3& b) noexcept {
  if (a.dot(b) <= 0.0) {
    return Vec3::Zero();
  }
  return a.squaredNorm() < b.squaredNorm() ? a : b;
}

}  // namespace

void Polygon::start(const Vec3& at, double s) {
  vertices_.restart(0);
  vertices_.push_back({at, Vec3::Zero(), at, Vec3::Zero(), Vec3::Zero(), s, 0.0});
}

void Polygon::push(const Vec3& end) {
  const std::size_t i = last();
  Vertex& from = vertices_[i];
  const Vec3 way = end - from.at;
  const double length = way.norm();
  from.direction = way / length;
  if (i > first()) {
    Vertex& before = vertices_[i - 1];
    const Vec3 change = from.direction - before.direction;
    const double length_before = from.s - before.s;
    from.turn = change.norm();
    from.bend = change * (2.0 / (length_before + length));
    from.aim = from.at + (length_before * length / 16.0) * from.bend;
    before.bulge = (-0.125 * length_before * length_before) * minmod(before.bend, from.bend);
  }
  const double s = from.s + length;
  vertices_.push_back({end, Vec3::Zero(), end, Vec3::Zero(), Vec3::Zero(), s, 0.0});
}

void Polygon::forget_turn(std::size_t i) noexcept {
  Vertex& vertex = vertices_[i];
  vertex.turn = 0.0;
  vertex.aim = vertex.at;
  vertex.bend = vertex.bulge = Vec3::Zero();
  if (i > first()) {
    vertices_[i - 1].bulge = Vec3::Zero();
  }
}

Vec3 Polygon::aim(std::size_t i, double s) const noexcept {
  const Vertex& from = vertices_[i];
  const Vertex& to = vertices_[i + 1];
  const double f = (s - from.s) / (to.s - from.s);
  return from.aim + f * (to.aim - from.aim) + (4.0 * f * (1.0 - f)) * from.bulge;
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

}  // namespace twin::geometry
