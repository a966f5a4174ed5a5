#include "results/trace/decimator.hpp"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

#include "results/trace/trace_reader.hpp"

namespace twin::results {

Decimator::Decimator(std::size_t columns, std::vector<std::size_t> watched, std::size_t max_rows)
    : columns_(columns),
      watched_(std::move(watched)),
      max_rows_(max_rows),
      max_buckets_((max_rows - 1) / slots() / 2 * 2) {
  assert(max_buckets_ >= 2);
}

void Decimator::push(std::span<const double> row) {
  assert(row.size() == columns_);
  if (!is_folded_ && count_ == max_rows_) {
    fold();
  }
  if (is_folded_) {
    const std::size_t buckets = index_.size() / slots();
    if (count_ % bucket_size_ != 0) {
      extend_bucket(buckets - 1, count_, row);
    } else {
      if (buckets == max_buckets_) {
        merge_neighbours();
      }
      open_bucket(row);  // max_buckets is even: the merged buckets are full
    }
    last_.assign(row.begin(), row.end());
  } else {
    kept_.insert(kept_.end(), row.begin(), row.end());
  }
  ++count_;
}

std::span<double> Decimator::slot_row(std::size_t bucket, std::size_t slot) noexcept {
  return {kept_.data() + (bucket * slots() + slot) * columns_, columns_};
}

void Decimator::open_bucket(std::span<const double> row) {
  for (std::size_t slot = 0; slot < slots(); ++slot) {
    kept_.insert(kept_.end(), row.begin(), row.end());
    index_.push_back(count_);
  }
}

/// Slot 0 is the bucket's first row, slots 1 + 2 i and 2 + 2 i hold the extremes of watched column
/// i.
void Decimator::extend_bucket(std::size_t bucket, std::size_t index, std::span<const double> row) {
  for (std::size_t i = 0; i < watched_.size(); ++i) {
    const double value = row[watched_[i]];
    for (const std::size_t slot : {1 + 2 * i, 2 + 2 * i}) {
      const std::span<double> kept = slot_row(bucket, slot);
      const bool is_minimum = slot % 2 == 1;
      if (is_minimum ? value < kept[watched_[i]] : value > kept[watched_[i]]) {
        std::copy(row.begin(), row.end(), kept.begin());
        index_[bucket * slots() + slot] = index;
      }
    }
  }
}

void Decimator::absorb(std::size_t into, std::size_t from) {
  for (std::size_t slot = 1; slot < slots(); ++slot) {
    extend_bucket(into, index_[from * slots() + slot], slot_row(from, slot));
  }
}

void Decimator::merge_neighbours() {
  const std::size_t pairs = index_.size() / slots() / 2;
  for (std::size_t pair = 0; pair < pairs; ++pair) {
    absorb(2 * pair, 2 * pair + 1);
    for (std::size_t slot = 0; slot < slots() && pair > 0; ++slot) {
      std::ranges::copy(slot_row(2 * pair, slot), slot_row(pair, slot).begin());
      index_[pair * slots() + slot] = index_[2 * pair * slots() + slot];
    }
  }
  kept_.resize(pairs * slots() * columns_);
  index_.resize(pairs * slots());
  bucket_size_ *= 2;
}

/// Turns the plain rows kept so far into buckets.
void Decimator::fold() {
  const std::vector<double> rows = std::exchange(kept_, {});
  is_folded_ = true;
  const std::size_t count = std::exchange(count_, 0);
  for (std::size_t i = 0; i < count; ++i) {
    push({rows.data() + i * columns_, columns_});
  }
}

Table Decimator::finish() {
  Table table{columns_, {}};
  if (!is_folded_) {
    table.values = std::move(kept_);
    return table;
  }
  kept_.insert(kept_.end(), last_.begin(), last_.end());
  index_.push_back(count_ - 1);
  std::vector<std::size_t> order(index_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [this](std::size_t slot) { return index_[slot]; });
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i == 0 || index_[order[i]] != index_[order[i - 1]]) {
      const auto row = kept_.begin() + static_cast<std::ptrdiff_t>(order[i] * columns_);
      table.values.insert(table.values.end(), row, row + static_cast<std::ptrdiff_t>(columns_));
    }
  }
  return table;
}

Expected<Table> load_decimated(const std::filesystem::path& file,
                               std::span<const std::string_view> columns, std::size_t max_rows) {
  std::vector<std::size_t> watched(columns.size());
  std::iota(watched.begin(), watched.end(), std::size_t{0});
  Decimator decimator(columns.size(), std::move(watched), max_rows);
  const auto push = [&decimator](std::span<const double> row) { decimator.push(row); };
  TWIN_CHECK(read_rows(file, columns, push));
  return decimator.finish();
}

}  // namespace twin::results
