#include "pictures/page/packed.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <limits>
#include <random>

namespace twin::pictures {
namespace packed_test {

/// The reverse of base64, by its definition.
std::string bytes_of(const std::string& text) {
  std::string bytes;
  std::uint32_t bits = 0;
  int held = 0;
  for (const char c : text) {
    if (c == '=') {
      break;
    }
    const int digit = c >= 'A' && c <= 'Z'   ? c - 'A'
                      : c >= 'a' && c <= 'z' ? c - 'a' + 26
                      : c >= '0' && c <= '9' ? c - '0' + 52
                      : c == '+'             ? 62
                                             : 63;
    bits = bits << 6U | static_cast<std::uint32_t>(digit);
    held += 6;
    if (held >= 8) {
      held -= 8;
      bytes.push_back(static_cast<char>(bits >> static_cast<unsigned>(held) & 255U));
    }
  }
  return bytes;
}

std::string inflated(const std::string& deflated, std::size_t size) {
  std::string bytes(size, '\0');
  uLongf got = size;
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(bytes.data()), &got,
                       reinterpret_cast<const Bytef*>(deflated.data()), deflated.size()),
            Z_OK);
  EXPECT_EQ(got, size);
  return bytes;
}

/// What a page makes of the planes of a column.
std::vector<double> unpacked(const std::string& bytes, std::size_t at, const PackedColumn& column) {
  std::vector<std::uint32_t> q(column.count);
  for (std::size_t i = 0; i < q.size(); ++i) {
    std::uint32_t u = 0;
    for (unsigned plane = 0; plane < column.planes; ++plane) {
      u |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + plane * q.size() + i]))
           << 8 * plane;
    }
    q[i] = (u & 1U) != 0 ? ~(u >> 1U) : u >> 1U;
  }
  for (int k = 0; k < column.order; ++k) {
    for (std::size_t i = 1; i < q.size(); ++i) {
      q[i] += q[i - 1];
    }
  }
  std::vector<double> values;
  for (const std::uint32_t x : q) {
    values.push_back(static_cast<std::int32_t>(x) * column.step);
  }
  return values;
}

TEST(Base64, IsThatOfTheStandard) {  // RFC 4648, section 10
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
}

TEST(Packer, EveryColumnComesBackToHalfAStep) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> noise(-1e3, 1e3);
  std::vector<double> wild(1000);
  std::vector<double> smooth;
  std::vector<double> steady(1000, -3.25);
  for (std::size_t i = 0; i < wild.size(); ++i) {
    wild[i] = noise(random);
    smooth.push_back(120.0 * std::sin(0.01 * static_cast<double>(i)));
  }
  Packer packer;
  const PackedColumn a = packer.add("wild", wild, 1e-2);
  const PackedColumn b = packer.add("smooth", smooth, 1e-5);
  const PackedColumn c = packer.add("steady", steady, 0.25);
  packer.add_bytes("text");
  const auto text = packer.finish();
  ASSERT_TRUE(text);
  const std::string bytes = inflated(bytes_of(*text), 1000 * (a.planes + b.planes + c.planes) + 4);
  const auto expect_back = [&](const std::vector<double>& values, const PackedColumn& column,
                               std::size_t at) {
    const auto back = unpacked(bytes, at, column);
    for (std::size_t i = 0; i < values.size(); ++i) {
      ASSERT_NEAR(back[i], values[i], 0.5 * column.step + 1e-9) << column.name << " " << i;
    }
  };
  expect_back(wild, a, 0);
  expect_back(smooth, b, 1000 * a.planes);
  expect_back(steady, c, 1000 * (a.planes + b.planes));
  EXPECT_EQ(bytes.substr(bytes.size() - 4), "text");
  EXPECT_LT(c.planes, a.planes);
  EXPECT_GT(b.order, 0);
}

TEST(Packer, ExtremesAndWhatIsNoNumberStayWithin32Bits) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Packer packer;
  const PackedColumn column =
      packer.add("x", {kInfinity, -kInfinity, std::nan(""), 1e300, -1e300, 5.0}, 1.0);
  const auto text = packer.finish();
  ASSERT_TRUE(text);
  const auto back = unpacked(inflated(bytes_of(*text), 6 * column.planes), 0, column);
  EXPECT_EQ(back[0], 2147483647.0);
  EXPECT_EQ(back[1], -2147483647.0);
  EXPECT_EQ(back[2], 0.0);
  EXPECT_EQ(back[3], 2147483647.0);
  EXPECT_EQ(back[5], 5.0);
}

}  // namespace packed_test
}  // namespace twin::pictures
