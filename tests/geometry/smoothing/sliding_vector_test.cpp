#include "geometry/smoothing/sliding_vector.hpp"

#include <gtest/gtest.h>

namespace twin::geometry {
namespace sliding_vector_test {

TEST(SlidingVector, KeepsTheIndicesOfWhatItKeeps) {
  SlidingVector<std::size_t> v;
  for (std::size_t i = 0; i < 1000; ++i) {
    v.push_back(i);
    v.drop_before(i > 10 ? i - 10 : 0);
    ASSERT_EQ(v.begin_index(), i > 10 ? i - 10 : 0);
    for (std::size_t k = v.begin_index(); k < v.end_index(); ++k) {
      ASSERT_EQ(v[k], k);
    }
  }
  EXPECT_EQ(v.size(), 11U);
  v.truncate(995);
  EXPECT_EQ(v.back(), 994U);
  v.restart(7);
  EXPECT_TRUE(v.is_empty());
  v.push_back(1);
  EXPECT_EQ(v.begin_index(), 7U);
}

}  // namespace sliding_vector_test
}  // namespace twin::geometry
