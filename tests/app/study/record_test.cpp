// SPDX-License-Identifier: MIT
#include "app/study/record.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "app/study/report.h"
#include "tests/program/run.h"
#include "tests/support/expect_error.h"

namespace grisaille::app::study {
namespace {

Record record(double cost, double error, const std::string& value = "1") {
  Record r;
  r.study = "study";
  r.backend = "null";
  r.setting = {{{"ssao", "radius"}, value}};
  r.errors = {{"", "one", error, 0.25, -0.125, 1.0 / 3, 0.9}};
  r.milliseconds = {{cost}};
  return r;
}

TEST(RecordTest, ComesBackBitForBit) {
  const tests::TemporaryFolder folder;
  Record r = record(0.1, 1.0 / 3, "0.3");
  r.device = "a \"device\"";
  r.command = "grisaille render 'x'";
  r.milliseconds = {{0.1}, {1e-300}, {3}};
  r.flicker = 1.0 / 7;
  r.pathRmse = 1.0 / 11;
  save(folder.path(), r);
  EXPECT_EQ(load(fileOf(folder.path(), r)), r);
  save(folder.path(), record(2, 0.2, "0.4"));
  EXPECT_EQ(loadAll(folder.path()).size(), 2u);
  EXPECT_EQ(load(folder.path() / "records/none.json"), std::nullopt);
  folder.write("records/bad.json", "{");
  EXPECT_ERROR(ErrorId::kStudyRecord, load(folder.path() / "records/bad.json"));
}

TEST(RecordTest, CostIsTheMedianAndItsSpreadTheQuartiles) {
  Record r = record(0, 0.5);
  r.milliseconds = {{5}, {1}, {100}, {2}, {3}};
  EXPECT_EQ(r.cost(), 3);
  EXPECT_EQ(r.spread(), 3);
  r.milliseconds = {{1}, {2}};
  EXPECT_EQ(r.cost(), 1.5);
  r.errors.push_back(r.errors[0]);
  r.errors[1].rmse = 0.25;
  EXPECT_EQ(r.rmse(), 0.375);
}

// A scene with many cameras weighs no more than one with few.
TEST(RecordTest, EveryScenesShareIsTheSame) {
  Record r = record(0, 0.6);
  r.errors[0].scene = "a";
  r.errors.push_back(r.errors[0]);
  r.errors[0].scene = "b";
  r.errors.push_back(r.errors[1]);
  r.errors[1].rmse = 0.1;
  r.errors[2].rmse = 0.3;
  EXPECT_EQ(r.shares(), (std::vector<double>{0.5, 0.25, 0.25}));
  EXPECT_DOUBLE_EQ(r.rmse(), 0.4);
  r.milliseconds = {{8, 4, 4}, {2, 8, 16}, {10, 12, 14}};
  EXPECT_DOUBLE_EQ(r.cost(), 7);
  EXPECT_DOUBLE_EQ(r.costOf(0), 8);
  EXPECT_DOUBLE_EQ(r.costOf(2), 14);
}

TEST(RecordTest, ARoundOfOtherCamerasIsDamage) {
  const tests::TemporaryFolder folder;
  Record r = record(1, 0.5);
  r.milliseconds.push_back({1, 2});
  save(folder.path(), r);
  EXPECT_ERROR(ErrorId::kStudyRecord, load(fileOf(folder.path(), r)));
}

TEST(ParetoFront, HoldsAllThatNothingBeats) {
  std::mt19937 random(5);
  std::uniform_int_distribution<int> small(1, 12);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Record> records;
    for (int i = 0; i < 30; ++i) records.push_back(record(small(random), small(random) / 16.0));
    const std::vector<size_t> front = paretoFront(records, "null");
    const auto beats = [&](const Record& a, const Record& b) {
      return a.cost() <= b.cost() && a.rmse() <= b.rmse() &&
             (a.cost() < b.cost() || a.rmse() < b.rmse());
    };
    for (const size_t i : front) {
      for (const Record& other : records) EXPECT_FALSE(beats(other, records[i]));
    }
    // Each record off the front is beaten by, or equals, a record on it.
    for (size_t i = 0; i < records.size(); ++i) {
      const bool on = std::ranges::find(front, i) != front.end();
      const bool covered = std::ranges::any_of(front, [&](size_t f) {
        return records[f].cost() <= records[i].cost() && records[f].rmse() <= records[i].rmse();
      });
      EXPECT_TRUE(on || covered);
    }
  }
  EXPECT_TRUE(paretoFront({}, "null").empty());
}

// Each estimator's settings have their own front, unless they are all settings.
TEST(ParetoFront, EachKindOfSettingHasItsOwn) {
  std::vector<Record> records;
  const auto add = [&](SettingText setting, double cost, double error) {
    setting.push_back({{"ssao", "radius"}, "1"});
    records.push_back(record(cost, error));
    records.back().setting = std::move(setting);
  };
  add({{{"ssao", "estimator"}, "new"}, {{"ssao", "kernel_size"}, "1"}}, 1, 0.5);
  add({{{"ssao", "estimator"}, "old"}, {{"ssao", "size"}, "1"}, {{"ssao", "blur"}, "box"}}, 2,
      0.75);
  add({{{"ssao", "kernel_size"}, "2"}, {{"ssao", "estimator"}, "new"}}, 2, 0.25);
  add({{{"ssao", "estimator"}, "old"}, {{"ssao", "size"}, "2"}, {{"ssao", "blur"}, "box"}}, 4,
      0.625);
  add({{{"ssao", "estimator"}, "old"}, {{"ssao", "size"}, "3"}, {{"ssao", "blur"}, "box"}}, 5,
      0.875);
  const std::vector<Kind> kinds = kindsOf(records);
  ASSERT_EQ(kinds.size(), 2u);
  EXPECT_EQ(kinds[0].name, "estimator=new");
  EXPECT_EQ(kinds[1].name, "estimator=old blur=box");
  EXPECT_EQ(kinds[1].records, (std::vector<size_t>{1, 3, 4}));
  EXPECT_EQ(paretoFront(records, "null"), (std::vector<size_t>{0, 2}));
  EXPECT_TRUE(ownFront(records, "null", kinds[0]).empty());
  EXPECT_EQ(ownFront(records, "null", kinds[1]), (std::vector<size_t>{1, 3}));
  EXPECT_TRUE(ownFront(records, "vulkan", kinds[1]).empty());
  EXPECT_TRUE(kindsOf({}).empty());
}

}  // namespace
}  // namespace grisaille::app::study
