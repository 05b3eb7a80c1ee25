// SPDX-License-Identifier: MIT
#include "lab/stability/result.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "app/truth/content_hash.h"
#include "core/base/atomic_file.h"
#include "core/base/regular_file.h"

namespace grisaille::lab::stability {
namespace fs = std::filesystem;
using nlohmann::json;
namespace {

double allowedShare(const Case& one) {
  const auto found = std::ranges::find(edges(), one.edge, &Edge::key);
  return found == edges().end() ? 1 - kShareWithin : found->share;
}

json toJson(const Apart& apart) {
  return {apart.pixels, apart.largest, apart.percentile99, apart.shareOver};
}

Apart apartFrom(const json& j) {
  return {j.at(0), j.at(1), j.at(2), j.at(3)};
}

fs::path fileOf(const fs::path& folder, const std::string& key) {
  app::truth::ContentHash hash;
  hash.add(key);
  return folder / fmt::format("{:016x}.json", hash.value());
}

}  // namespace

Apart apartOf(std::vector<float> differences) {
  Apart apart{.pixels = differences.size()};
  if (differences.empty()) return apart;
  uint64_t over = 0;
  for (float& one : differences) {
    if (!std::isfinite(one)) one = 1;
    over += one > kTolerance ? 1 : 0;
  }
  std::ranges::sort(differences);
  apart.largest = differences.back();
  apart.percentile99 = differences[(differences.size() - 1) * 99 / 100];
  apart.shareOver = static_cast<double>(over) / static_cast<double>(differences.size());
  return apart;
}

std::vector<std::string> faultsOf(const Case& one, const Result& result) {
  std::vector<std::string> faults;
  const double allowed = allowedShare(one);
  for (const BackendResult& b : result.backends) {
    const auto fault = [&](const std::string& text) { faults.push_back(b.backend + ": " + text); };
    if (!b.error.empty()) fault(b.error);
    if (b.nonFinite > 0) fault(fmt::format("{} values are not finite", b.nonFinite));
    if (b.outside > 0) fault(fmt::format("{} values are outside their range", b.outside));
    if (b.oracle.shareOver > allowed) {
      fault(fmt::format("{:.3f} % of pixels are over 2/255 from the oracle, at most {:.3f}",
                        100 * b.oracle.shareOver, 100 * allowed));
    }
    if (b.leastOpen && *b.leastOpen < kLeastOpen) {
      fault(fmt::format("a plane has a visibility of {:.3f}", *b.leastOpen));
    }
    if (b.cornerError && !(*b.cornerError <= kCornerError)) {
      fault(fmt::format("a right angle is {:.3f} off", *b.cornerError));
    }
  }
  if (result.between && result.between->shareOver > allowed) {
    faults.push_back(fmt::format("{:.3f} % of pixels are over 2/255 apart on the two backends",
                                 100 * result.between->shareOver));
  }
  return faults;
}

void saveResult(const fs::path& folder, const Result& result) {
  json all = {{"key", result.key}, {"backends", json::array()}};
  for (const BackendResult& b : result.backends) {
    json one = {{"backend", b.backend},       {"error", b.error},
                {"non_finite", b.nonFinite},  {"outside", b.outside},
                {"oracle", toJson(b.oracle)}, {"seconds", b.seconds},
                {"touched", b.touched},       {"bits", b.bits}};
    if (b.leastOpen) one["least_open"] = *b.leastOpen;
    if (b.cornerError) one["corner_error"] = *b.cornerError;
    all["backends"].push_back(one);
  }
  if (result.between) all["between"] = toJson(*result.between);
  std::error_code failed;
  fs::create_directories(folder, failed);
  writeFileAtomically(fileOf(folder, result.key).string(), all.dump(1) + "\n");
}

std::optional<Result> loadResult(const fs::path& folder, const std::string& key) {
  auto stream = openRegularFileIfThere(fileOf(folder, key), ErrorId::kStudyRecord);
  if (!stream) return std::nullopt;
  try {
    const json j = json::parse(*stream);
    Result result{.key = j.at("key"), .backends = {}, .between = {}};
    if (result.key != key) return std::nullopt;
    for (const json& one : j.at("backends")) {
      BackendResult& b = result.backends.emplace_back();
      b.backend = one.at("backend");
      b.error = one.at("error");
      b.nonFinite = one.at("non_finite");
      b.outside = one.at("outside");
      b.oracle = apartFrom(one.at("oracle"));
      b.seconds = one.at("seconds");
      b.touched = one.at("touched");
      b.bits = one.at("bits");
      if (one.contains("least_open")) b.leastOpen = one["least_open"].get<double>();
      if (one.contains("corner_error")) b.cornerError = one["corner_error"].get<double>();
    }
    if (j.contains("between")) result.between = apartFrom(j["between"]);
    return result;
  } catch (const json::exception&) {
    return std::nullopt;  // damaged: the case runs again
  }
}

}  // namespace grisaille::lab::stability
