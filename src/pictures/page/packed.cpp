#include "pictures/page/packed.hpp"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace twin::pictures {
namespace {

constexpr int kMostOrder = 3;
constexpr int kDeflateLevel = 5;  // one more shrinks a page by a hundredth and takes half as long

/// A number of 32 bits: its differences are taken modulo 2^32, as the page sums them up.
std::int32_t whole(double x, double step) {
  constexpr double kMost = std::numeric_limits<std::int32_t>::max();
  const double q = std::nearbyint(x / step);
  return std::isnan(q) ? 0 : static_cast<std::int32_t>(std::clamp(q, -kMost, kMost));
}

std::uint32_t folded(std::int32_t d) {
  const auto u = static_cast<std::uint32_t>(d);
  return (u << 1U) ^ (d < 0 ? 0xFFFFFFFFU : 0U);
}

void difference(std::vector<std::int32_t>& q) {
  for (std::size_t i = q.size(); i-- > 1;) {
    q[i] = static_cast<std::int32_t>(static_cast<std::uint32_t>(q[i]) -
                                     static_cast<std::uint32_t>(q[i - 1]));
  }
}

/// Bits that the numbers take.
std::size_t size_of(const std::vector<std::int32_t>& q) {
  std::size_t bits = 0;
  for (const std::int32_t d : q) {
    bits += static_cast<std::size_t>(std::bit_width(folded(d)));
  }
  return bits;
}

}  // namespace

PackedColumn Packer::add(std::string name, const std::vector<double>& values, double step) {
  std::vector<std::int32_t> q(values.size());
  std::ranges::transform(values, q.begin(), [step](double x) { return whole(x, step); });
  std::vector<std::int32_t> best = q;
  std::size_t least = size_of(q);
  int order = 0;
  for (int k = 1; k <= kMostOrder; ++k) {
    difference(q);
    if (const std::size_t size = size_of(q); size < least) {
      least = size;
      best = q;
      order = k;
    }
  }
  std::uint32_t all = 0;
  for (const std::int32_t d : best) {
    all |= folded(d);
  }
  const auto planes = static_cast<unsigned>(std::bit_width(all) + 7) / 8;
  for (unsigned plane = 0; plane < planes; ++plane) {
    for (const std::int32_t d : best) {
      bytes_.push_back(static_cast<char>((folded(d) >> (8 * plane)) & 0xFFU));
    }
  }
  return {std::move(name), step, order, planes, values.size()};
}

Expected<std::string> Packer::finish() const {
  uLongf size = compressBound(static_cast<uLong>(bytes_.size()));
  std::string deflated(size, '\0');
  // zlib takes bytes as unsigned char.
  const auto* const from = reinterpret_cast<const Bytef*>(bytes_.data());
  auto* const to = reinterpret_cast<Bytef*>(deflated.data());
  if (compress2(to, &size, from, static_cast<uLong>(bytes_.size()), kDeflateLevel) != Z_OK) {
    return fail(ErrorCode::kFile, "there is not enough memory to pack the page");
  }
  deflated.resize(size);
  return base64(deflated);
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8U | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      const bool is_there = i + k <= bytes.size();
      text.push_back(is_there ? kDigits[group >> (18U - 6U * static_cast<unsigned>(k)) & 63U]
                              : '=');
    }
  }
  return text;
}

}  // namespace twin::pictures
