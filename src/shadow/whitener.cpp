#include "shadow/whitener.hpp"

#include <algorithm>

namespace twin::shadow {
namespace {

SignalRow difference(const SignalRow& a, const SignalRow& b) noexcept {
  SignalRow row;
  row.residual = a.residual - b.residual;
  for (std::size_t i = 0; i < kParameters; ++i) {
    row.signature[i] = a.signature[i] - b.signature[i];
  }
  return row;
}

void subtract(const SignalRow& from, double factor, SignalRow& row) noexcept {
  row.residual -= factor * from.residual;
  for (std::size_t i = 0; i < kParameters; ++i) {
    row.signature[i] -= factor * from.signature[i];
  }
}

}  // namespace

Whitener::Whitener(std::span<const double> coefficients, bool is_differenced)
    : coefficients_(coefficients.begin(), coefficients.end()),
      is_differenced_(is_differenced),
      past_(2 * coefficients.size()) {}

void Whitener::reset() noexcept {
  rows_ = next_ = 0;
  std::ranges::fill(past_, SignalRow{});
}

bool Whitener::step(const SignalRow& raw, SignalRow& white) noexcept {
  const std::size_t order = coefficients_.size();
  const SignalRow here = is_differenced_ && rows_ > 0 ? difference(raw, last_) : raw;
  last_ = raw;
  ++rows_;
  if (is_differenced_ && rows_ == 1) {
    return false;
  }
  white = here;
  // past_[next_ + order - j] is the increment of j periods ago.
  for (std::size_t j = 1; j <= order; ++j) {
    subtract(past_[next_ + order - j], coefficients_[j - 1], white);
  }
  if (order > 0) {
    past_[next_] = past_[next_ + order] = here;
    next_ = next_ + 1 == order ? 0 : next_ + 1;
  }
  return rows_ > order + (is_differenced_ ? 1 : 0);
}

JumpShapes shapes_of(const Whitener& whitener, double count,
                     const std::vector<double>& force_response) {
  const std::size_t length = whitener.order() + 1;
  const auto passed = [&](auto&& value_at) {
    Whitener copy = whitener;
    copy.reset();
    SignalRow white;
    copy.step({}, white);
    std::vector<double> shape;
    for (std::size_t k = 0; k < length; ++k) {
      SignalRow row;
      row.residual = value_at(k);
      copy.step(row, white);
      shape.push_back(white.residual);
    }
    return shape;
  };
  JumpShapes shapes;
  shapes.count = count;
  shapes.step = passed([](std::size_t) { return 1.0; });
  if (force_response.size() >= length) {
    shapes.force = passed([&](std::size_t k) { return force_response[k]; });
  }
  return shapes;
}

std::vector<double> autoregression(std::span<const double> covariance) {
  std::vector<double> a;
  double variance = covariance.front();
  for (std::size_t k = 1; k < covariance.size() && variance > 0.0; ++k) {
    double sum = covariance[k];
    for (std::size_t j = 0; j < a.size(); ++j) {
      sum -= a[j] * covariance[k - 1 - j];
    }
    const double reflection = std::clamp(sum / variance, -0.9999, 0.9999);
    std::vector<double> longer(a);
    for (std::size_t j = 0; j < a.size(); ++j) {
      longer[j] -= reflection * a[a.size() - 1 - j];
    }
    longer.push_back(reflection);
    a = std::move(longer);
    variance *= 1.0 - reflection * reflection;
  }
  return a;
}

}  // namespace twin::shadow
