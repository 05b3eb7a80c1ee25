// SPDX-License-Identifier: MIT
#include "app/viewer/pass_stats.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace grisaille::app::viewer {
namespace {

gpu::FrameTimes frameOf(std::vector<gpu::PassTime> passes, double whole = 0) {
  return {.frame = 0, .passes = std::move(passes), .wholeMilliseconds = whole};
}

TEST(PassTimes, AreInTheOrderOfTheLastFrame) {
  PassTimes times;
  EXPECT_TRUE(times.all().empty());
  EXPECT_TRUE(times.whole().recent.empty());
  times.add(frameOf({{"a", 1}, {"b", 2}, {"c", 3}}, 6));
  times.add(frameOf({{"c", 5}, {"a", 3}, {"c", 2}, {"d", 9}}, 19));
  const std::vector<PassStats> all = times.all();
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0].label, "c");
  EXPECT_EQ(all[0].recent, (std::vector<float>{3, 7}));  // passes of one label are added
  EXPECT_EQ(all[0].mean, 5);
  EXPECT_EQ(all[1].label, "a");
  EXPECT_EQ(all[1].recent, (std::vector<float>{1, 3}));
  EXPECT_EQ(all[2].label, "d");
  EXPECT_EQ(times.whole().recent, (std::vector<float>{6, 19}));
  times.add(frameOf({{"b", 4}}));
  ASSERT_EQ(times.all().size(), 1u);
  EXPECT_EQ(times.all()[0].recent, (std::vector<float>{4}));  // forgotten, then started again
  times.clear();
  EXPECT_TRUE(times.all().empty());
  EXPECT_TRUE(times.whole().recent.empty());
}

// Compared with the plain definitions over all frames that count.
TEST(PassTimes, KeepTheLastFrames) {
  std::mt19937_64 random(1);
  PassTimes times;
  std::vector<float> costs;
  for (size_t count = 1; count <= 1000; ++count) {
    costs.push_back(std::lognormal_distribution<float>()(random));
    times.add(frameOf({{"a", costs.back()}}, 2.0 * costs.back()));
    const std::vector<float> last(
        costs.end() - static_cast<ptrdiff_t>(std::min(count, PassTimes::kFramesKept)), costs.end());
    const PassStats stats = times.all().at(0);
    ASSERT_EQ(stats.recent, last);
    const double sum = std::accumulate(last.begin(), last.end(), 0.0);
    EXPECT_NEAR(stats.mean, sum / static_cast<double>(last.size()), 1e-9);
    // The smallest value that at least 95 % do not exceed.
    std::vector<float> sorted = last;
    std::ranges::sort(sorted);
    const auto rank = std::ranges::find_if(sorted, [&](const float& value) {
      return 100 * static_cast<size_t>(&value - sorted.data() + 1) >= 95 * sorted.size();
    });
    ASSERT_EQ(stats.p95, *rank) << count;
    EXPECT_NEAR(times.whole().p95, 2 * stats.p95, 1e-4 * stats.p95);
  }
}

TEST(PassTimesTest, CsvHasALineAFrame) {
  PassTimes times;
  times.add(frameOf({{"a", 1}}, 2));
  times.add(frameOf({{"a", 3}, {"b", 0.5}}, 4));
  EXPECT_EQ(times.sum().recent, (std::vector<float>{1, 3.5}));
  std::vector<PassStats> columns = times.all();
  columns.push_back(times.sum());
  columns.push_back(times.whole());
  EXPECT_EQ(costCsv(columns),
            "frame number,a ms,b ms,sum of passes ms,frame ms\n"
            "1,1.0000,,1.0000,2.0000\n"
            "2,3.0000,0.5000,3.5000,4.0000\n");
  EXPECT_EQ(costCsv({}), "frame number\n");
}

}  // namespace
}  // namespace grisaille::app::viewer
