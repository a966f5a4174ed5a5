#include "shadow/onset_bank.hpp"

#include <utility>

namespace twin::shadow {

OnsetBank::OnsetBank(std::vector<double> response)
    : response_(std::move(response)), slots_(kLasts / kEvery) {}

void OnsetBank::step(const CountFilter::Row& row) noexcept {
  if (row.has_begun) {
    for (Slot& slot : slots_) {
      slot.age = kLasts;
    }
    since_ = 0;
  }
  if (since_ == 0) {
    slots_[next_] = {};
    slots_[next_].age = 0;
    next_ = next_ + 1 == slots_.size() ? 0 : next_ + 1;
  }
  since_ = since_ + 1 == kEvery ? 0 : since_ + 1;
  for (Slot& slot : slots_) {
    if (slot.age >= kLasts) {
      continue;
    }
    double here = response_[slot.age++];
    for (std::size_t j = 0; j < CountFilter::kStates; ++j) {
      here -= row.observed[j] * slot.state[j];
    }
    for (std::size_t j = 0; j < CountFilter::kStates; ++j) {
      slot.state[j] += row.gain[j] * here;
    }
    const double weighted = row.white.weight * here;
    slot.onset.score += row.white.score * here;
    slot.onset.information += weighted * here;
    for (std::size_t i = 0; i < kParameters; ++i) {
      slot.onset.cross[i] += weighted * row.white.signature[i];
    }
  }
}

Onset OnsetBank::best(std::size_t ago, std::size_t periods) const noexcept {
  Onset found;
  for (const Slot& slot : slots_) {
    const bool is_there =
        slot.age > 0 && slot.age < kLasts && slot.age <= ago + 1 && slot.age + periods > ago + 1;
    if (is_there && slot.onset.explained() > found.explained()) {
      found = slot.onset;
    }
  }
  return found;
}

}  // namespace twin::shadow
