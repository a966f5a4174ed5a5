#include "hal/mujoco/encoder.hpp"

#include <gtest/gtest.h>

namespace twin::hal::mujoco {
namespace encoder_test {

Encoder make(double mm_per_count, double phase) {
  EncoderParams params;
  params.mm_per_count = mm_per_count;
  params.phase = phase;
  return Encoder(params);
}

TEST(Encoder, CountsAreMonotonicAndNeverMoreThanHalfACountOffAtPhaseOneHalf) {
  const Encoder encoder = make(0.01, 0.5);
  std::int64_t last = encoder.counts(-1.0);
  for (double x = -1.0; x < 1.0; x += 0.00037) {
    const std::int64_t counts = encoder.counts(x);
    EXPECT_GE(counts, last);
    EXPECT_LE(std::abs(static_cast<double>(counts) * 0.01 - x), 0.005 + 1e-12);
    last = counts;
  }
}

TEST(Encoder, PhaseShiftsTheEdgesByItsShareOfACount) {
  const Encoder early = make(0.01, 0.9);
  const Encoder late = make(0.01, 0.1);
  EXPECT_EQ(early.counts(0.0009), 0);
  EXPECT_EQ(early.counts(0.0011), 1);
  EXPECT_EQ(late.counts(0.0089), 0);
  EXPECT_EQ(late.counts(0.0091), 1);
}

TEST(Encoder, NegativeScaleCountsBackwards) {
  const Encoder encoder = make(-0.01, 0.5);
  EXPECT_EQ(encoder.counts(1.0), -100);
  EXPECT_EQ(encoder.counts(-1.0), 100);
}

TEST(Encoder, ZeroIsWhereItWasSet) {
  Encoder encoder = make(0.01, 0.5);
  encoder.zero(12.34567);
  EXPECT_EQ(encoder.counts(12.34567), 0);
  EXPECT_EQ(encoder.counts(13.34567), 100);
}

}  // namespace encoder_test
}  // namespace twin::hal::mujoco
