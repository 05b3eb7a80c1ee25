// SPDX-License-Identifier: MIT
#include "core/effect/values.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "grisaille/effect.hpp"
#include "tests/support/expect_error.h"

namespace grisaille::effect {
namespace {

constexpr const char* kKeys[] = {"box", "edge_aware", "none"};
constexpr const char* kLabels[] = {"Box", "Edge-aware", "None"};
constexpr grisaille_param_desc kParams[] = {
    plugin::floatParam({.key = "radius",
                        .label = "Radius",
                        .unit = "m",
                        .tooltip = "How far",
                        .hardMin = -1e6,
                        .hardMax = 1e6,
                        .softMin = 0.01,
                        .softMax = 10,
                        .defaultValue = 0.5,
                        .log = true}),
    plugin::intParam({.key = "kernel_size",
                      .label = "Kernel size",
                      .tooltip = "How many",
                      .hardMin = 1,
                      .hardMax = 256,
                      .softMin = 4,
                      .softMax = 64,
                      .defaultValue = 16}),
    plugin::boolParam({.key = "noise",
                       .label = "Noise",
                       .tooltip = "Whether",
                       .usedWhen = {.key = "blur", .value = 2}}),
    plugin::enumParam({.key = "blur",
                       .label = "Blur",
                       .tooltip = "Which",
                       .keys = kKeys,
                       .labels = kLabels,
                       .defaultValue = 1})};

struct ValuesTest : testing::Test {
  grisaille_effect_desc desc = [] {
    grisaille_effect_desc d = {};
    d.key = "ssao";
    d.param_count = std::size(kParams);
    d.params = kParams;
    return d;
  }();
  Values values{Effect{&desc, "memory"}};

  // Expects that setting `key` fails without changing the value. Returns the error's detail.
  std::string refused(ErrorId id, std::string_view key, std::string_view text) {
    const double before = values.all()[1];
    try {
      values.set(key, text);
      ADD_FAILURE() << key << "=" << text << " was accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error.id(), id) << error.what();
      EXPECT_EQ(values.all()[1], before);
      return error.detail();
    }
    return {};
  }
};

TEST_F(ValuesTest, BeginsWithDefaults) {
  EXPECT_EQ(values.get("radius"), 0.5);
  EXPECT_EQ(values.get("kernel_size"), 16);
  EXPECT_EQ(values.get("noise"), 0);
  EXPECT_EQ(values.get("blur"), 1);
}

TEST_F(ValuesTest, ADefaultThatIsFittedYieldsToAValueThatIsSet) {
  values.fit("radius", 3);
  EXPECT_EQ(values.get("radius"), 3);
  EXPECT_FALSE(values.given("radius"));
  values.set("radius", "7");
  values.fit("radius", 4);
  EXPECT_EQ(values.get("radius"), 7);
  EXPECT_TRUE(values.given("radius"));
  EXPECT_EQ(values.defaultOf("radius"), 4);
  values.reset("radius");
  EXPECT_EQ(values.get("radius"), 4);
  EXPECT_FALSE(values.given("radius"));
  EXPECT_ERROR(ErrorId::kParameterRange, values.fit("radius", 1e7));
  EXPECT_EQ(values.get("radius"), 4);
  values.set("kernel_size", "3");
  values.reset();
  EXPECT_EQ(values.get("kernel_size"), 16);
}

TEST_F(ValuesTest, TakesEveryWayToWriteAValue) {
  const struct {
    const char *key, *text;
    double value;
  } cases[] = {{"radius", "1e-3", 1e-3},    {"radius", "-0.5", -0.5}, {"radius", "7", 7},
               {"radius", "1e6", 1e6},      {"kernel_size", "1", 1},  {"kernel_size", "256", 256},
               {"kernel_size", "64.0", 64}, {"noise", "true", 1},     {"noise", "false", 0},
               {"noise", "on", 1},          {"noise", "off", 0},      {"noise", "1", 1},
               {"noise", "0", 0},           {"blur", "box", 0},       {"blur", "none", 2}};
  for (const auto& c : cases) {
    values.set(c.key, c.text);
    EXPECT_EQ(values.get(c.key), c.value) << c.key << "=" << c.text;
  }
}

TEST_F(ValuesTest, KnowsWhichParametersTheOthersLetItUse) {
  EXPECT_TRUE(values.isUsed(kParams[0]));
  EXPECT_EQ(usedWhenText(values.effect(), kParams[0]), "");
  EXPECT_FALSE(values.isUsed(kParams[2]));
  EXPECT_EQ(usedWhenText(values.effect(), kParams[2]), "blur = none");
  values.set("blur", "none");
  EXPECT_TRUE(values.isUsed(kParams[2]));
}

TEST_F(ValuesTest, RefusesWhatIsNoValueOfTheType) {
  for (const char* text : {"", " ", "x", "1x", "1 ", " 1", "+1", "1,5", "0x10", "nan", "inf",
                           "-inf", "1e", "--1", "1\n"}) {
    refused(ErrorId::kParameterType, "radius", text);
    refused(ErrorId::kParameterType, "kernel_size", text);
  }
  refused(ErrorId::kParameterType, "kernel_size", "1.5");
  for (const char* text : {"", "True", "yes", "2", "1.0"}) {
    refused(ErrorId::kParameterType, "noise", text);
  }
  EXPECT_ERROR(ErrorId::kParameterType,
               values.set("radius", std::numeric_limits<double>::quiet_NaN()));
  EXPECT_ERROR(ErrorId::kParameterType, values.set("noise", 0.5));
  EXPECT_ERROR(ErrorId::kParameterType, values.set("blur", 0.5));
}

TEST_F(ValuesTest, RefusesValuesOutsideAndNamesTheNearest) {
  EXPECT_NE(refused(ErrorId::kParameterRange, "kernel_size", "257").find("256"), std::string::npos);
  EXPECT_NE(refused(ErrorId::kParameterRange, "kernel_size", "0").find("is 1"), std::string::npos);
  EXPECT_NE(refused(ErrorId::kParameterRange, "radius", "1e7").find("1e+06 m"), std::string::npos);
  refused(ErrorId::kParameterRange, "radius", "1e999");
  EXPECT_NE(refused(ErrorId::kParameterRange, "blur", "bx").find("is box"), std::string::npos);
  refused(ErrorId::kParameterRange, "blur", "1");
  refused(ErrorId::kParameterRange, "blur", "");
  EXPECT_ERROR(ErrorId::kParameterRange, values.set("blur", 3.0));
  EXPECT_ERROR(ErrorId::kParameterRange, values.set("noise", 2.0));
}

TEST_F(ValuesTest, UnknownKeyNamesTheNearest) {
  EXPECT_NE(refused(ErrorId::kParameterUnknown, "kernal_size", "1").find("kernel_size"),
            std::string::npos);
  EXPECT_NE(refused(ErrorId::kParameterUnknown, "raduis", "1").find("radius"), std::string::npos);
  EXPECT_EQ(refused(ErrorId::kParameterUnknown, "xyzzy", "1").find("nearest"), std::string::npos);
}

TEST_F(ValuesTest, TextRoundTripsEveryValue) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 20000; ++i) {
    const double value = std::bit_cast<double>(random());
    if (!(std::abs(value) <= 1e6)) continue;
    values.set("radius", value);
    const std::string text = values.text("radius");
    values.set("radius", 0.5);
    values.set("radius", text);
    ASSERT_EQ(std::bit_cast<uint64_t>(values.get("radius")), std::bit_cast<uint64_t>(value))
        << text;
  }
  for (const auto& [key, most] : {std::pair{"kernel_size", 256}, {"noise", 1}, {"blur", 2}}) {
    for (int value = key[0] == 'k' ? 1 : 0; value <= most; ++value) {
      values.set(key, static_cast<double>(value));
      const std::string text = values.text(key);
      values.set(key, text);
      ASSERT_EQ(values.get(key), value) << key << "=" << text;
    }
  }
}

}  // namespace
}  // namespace grisaille::effect
