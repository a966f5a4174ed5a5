#include "runtime/kept_path.hpp"

#include <algorithm>

namespace twin::runtime {

void KeptPath::add(const path::Segment& segment) {
  pieces_.push_back({segment, length_});
  length_ += segment.length;
}

void KeptPath::drop_before(std::int64_t segment) {
  if (segment <= first_ || segment >= end()) {
    return;
  }
  for (const std::int64_t last = lead_in(segment); first_ < last; ++first_) {
    pieces_.pop_front();
  }
}

std::int64_t KeptPath::lead_in(std::int64_t index) const {
  std::int64_t lead = index;
  const double begin = begin_of(index);
  while (lead > first_ && begin - begin_of(lead) < behind_ && !(*this)[lead - 1].stops_at_end &&
         (*this)[lead - 1].length > 0.0) {
    --lead;
  }
  return lead;
}

}  // namespace twin::runtime
