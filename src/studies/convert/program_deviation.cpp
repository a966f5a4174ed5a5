#include "studies/convert/program_deviation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "gcode/block.hpp"
#include "results/metrics/block_distance.hpp"

namespace twin::studies::convert {
namespace {

constexpr int kPlaces = 8;             // to a block
constexpr double kAround = 1.0;        // arc length searched on either side [mm]
constexpr double kLengthShare = 1e-5;  // and that much of the whole

/// Blocks one after the other, with arc length.
class Chain {
 public:
  Expected<void> read(gcode::Reader& reader, std::int64_t count) {
    blocks_.clear();
    ends_.clear();
    for (; count > 0; --count) {
      TWIN_TRY(auto block, reader.next());
      if (!block.has_value()) {
        return fail(ErrorCode::kProgram, "the new program ends before its time");
      }
      ends_.push_back(length() + results::block_length(*block, results::View::kSpace));
      blocks_.push_back(std::move(*block));
    }
    return {};
  }

  bool is_empty() const { return blocks_.empty(); }
  double length() const { return ends_.empty() ? 0.0 : ends_.back(); }

  /// Calls a function with places and the share of the arc length there.
  template <class Visit>
  void visit_places(Visit visit) const {
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
      const double begin = i == 0 ? 0.0 : ends_[i - 1];
      if (blocks_[i].motion == gcode::Motion::kNurbs) {
        const gcode::ProgrammedCurve& programmed = *blocks_[i].nurbs;
        for (const geometry::CurvatureSample& sample : programmed.samples) {
          visit(programmed.curve.position(sample.u), (begin + sample.s) / length());
        }
        continue;
      }
      for (int k = 0; k <= kPlaces; ++k) {
        const double fraction = static_cast<double>(k) / kPlaces;
        const double s = begin + fraction * (ends_[i] - begin);
        visit(results::point_at(blocks_[i], fraction), length() > 0.0 ? s / length() : 0.0);
      }
    }
  }

  double distance(const Vec3& place, double share) const {
    const double s = share * length();
    const double around = kAround + kLengthShare * length();
    double least = std::numeric_limits<double>::infinity();
    auto i = static_cast<std::size_t>(std::lower_bound(ends_.begin(), ends_.end(), s - around) -
                                      ends_.begin());
    for (i = std::min(i, blocks_.size() - 1); i < blocks_.size(); ++i) {
      const double begin = i == 0 ? 0.0 : ends_[i - 1];
      if (begin > s + around) {
        break;
      }
      const double size = ends_[i] - begin;
      const double from = size > 0.0 ? std::clamp((s - around - begin) / size, 0.0, 1.0) : 0.0;
      const double to = size > 0.0 ? std::clamp((s + around - begin) / size, from, 1.0) : 1.0;
      least = std::min(
          least, results::nearest(blocks_[i], place, results::View::kSpace, from, to).distance);
    }
    return least;
  }

 private:
  std::vector<gcode::Block> blocks_;
  std::vector<double> ends_;  // arc length [mm]
};

double largest_distance(const Chain& one, const Chain& other) {
  double largest = 0.0;
  const auto against = [&largest](const Chain& path) {
    return [&largest, &path](const Vec3& place, double share) {
      largest = std::max(largest, path.distance(place, share));
    };
  };
  one.visit_places(against(other));
  other.visit_places(against(one));
  return largest;
}

}  // namespace

Expected<Deviation> compare_programs(gcode::Reader& before, gcode::Reader& after,
                                     std::span<const Group> groups) {
  Deviation worst;
  double worst_share = -1.0;
  Chain one;
  Chain other;
  for (const Group& group : groups) {
    TWIN_CHECK(one.read(before, group.blocks));
    TWIN_CHECK(other.read(after, group.made));
    const double largest = other.is_empty() ? one.length() : largest_distance(one, other);
    if (largest / group.tolerance > worst_share) {
      worst_share = largest / group.tolerance;
      worst = {largest, group.tolerance, group.line};
    }
  }
  if (auto end = after.next(); !end || end->has_value()) {
    return end ? fail(ErrorCode::kProgram, "the new program has more blocks than it should")
               : tl::unexpected<Error>(end.error());
  }
  return worst;
}

}  // namespace twin::studies::convert
