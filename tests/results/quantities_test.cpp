#include "results/quantities.hpp"

#include <gtest/gtest.h>

#include <set>

#include "core/json.hpp"

namespace twin::results {
namespace quantities_test {

/// A run in which everything was measured.
Summary whole() {
  Summary s;
  s.certified = Certificate{};
  s.plan_fallbacks = 1;
  s.time_bound = 1.0;
  s.planning_time = 1.0;
  s.run = MachineResults{};
  s.run->realtime = RealTimeStats{};
  s.cutting = CuttingStats{};
  s.cutting->run = CuttingErrors{};
  return s;
}

TEST(Quantities, KeysAndPlacesAreUnique) {
  std::set<std::string_view> keys;
  std::set<std::string_view> pointers;
  for (const Quantity& q : quantities()) {
    EXPECT_TRUE(keys.insert(q.key).second) << q.key;
    EXPECT_TRUE(q.pointer.empty() || pointers.insert(q.pointer).second) << q.pointer;
    EXPECT_EQ(&quantity(q.key), &q);
  }
}

/// "um" is the end of "contour_error_max_um", "mm/s^2" that of "..._mm_per_s2".
TEST(Quantities, KeyEndsWithTheUnit) {
  for (const Quantity& q : quantities()) {
    std::string unit(q.unit);
    if (const auto slash = unit.find('/'); slash != std::string::npos) {
      unit.replace(slash, 1, "_per_");
    }
    std::erase(unit, '^');
    unit = unit == "%" ? "percent" : unit;
    EXPECT_TRUE(unit.empty() || q.key.ends_with("_" + unit)) << q.key << " " << q.unit;
  }
}

TEST(Quantities, SummaryFileHasEachAtItsPlace) {
  const auto json = parse_json(to_json(whole()));
  for (const Quantity& q : quantities()) {
    ASSERT_TRUE(q.get(whole())) << q.key;
    if (!q.pointer.empty()) {
      const auto& value = json.at(Json::json_pointer(std::string(q.pointer)));
      EXPECT_EQ(value.is_number_integer(), q.kind == QuantityKind::kCount) << q.key;
    }
  }
}

TEST(Quantities, PlanHasNoneOfAMachine) {
  EXPECT_FALSE(quantity("machining_time_s").get(Summary{}));
  EXPECT_FALSE(quantity("y_tracking_error_rms_um").get(Summary{}));
  EXPECT_FALSE(quantity("late_periods").get(Summary{}));
  EXPECT_TRUE(quantity("command_contour_error_max_um").get(Summary{}));
}

TEST(Quantities, ValuesAreInTheUnitOfTheKey) {
  Summary s = whole();
  s.run->tracking_error[1].rms = 0.0088;
  s.run->realtime->wake_up.p999 = 2e-5;
  s.feedrate_fluctuation.max = 0.25;
  s.planned_time = 1.5;
  s.blocks.total = 200;
  EXPECT_DOUBLE_EQ(*quantity("y_tracking_error_rms_um").get(s), 8.8);
  EXPECT_DOUBLE_EQ(*quantity("wake_up_p999_us").get(s), 20.0);
  EXPECT_DOUBLE_EQ(*quantity("feedrate_fluctuation_max_percent").get(s), 25.0);
  EXPECT_DOUBLE_EQ(*quantity("bound_ratio").get(s), 1.5);
  EXPECT_DOUBLE_EQ(*quantity("planning_time_per_block_us").get(s), 5000.0);
  EXPECT_EQ(quantity("y_tracking_error_rms_um").text(8.8), "8.800");
  EXPECT_EQ(quantity("y_tracking_error_rms_um").text(std::nullopt), "-");
  EXPECT_EQ(quantity("y_tracking_error_rms_um").name(), "tracking error, y, rms");
}

}  // namespace quantities_test
}  // namespace twin::results
