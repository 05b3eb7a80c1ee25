// SPDX-License-Identifier: MIT
#include "app/study/record.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>

#include "app/truth/content_hash.h"
#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/regular_file.h"

namespace grisaille::app::study {
namespace fs = std::filesystem;
using nlohmann::json;
namespace {

constexpr int kVersion = 2;

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  std::ranges::sort(values);
  const double at = share * static_cast<double>(values.size() - 1);
  const auto below = static_cast<size_t>(at);
  const size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (at - static_cast<double>(below)) * (values[above] - values[below]);
}

// The mean cost of each round.
std::vector<double> roundsOf(const Record& r) {
  const std::vector<double> share = r.shares();
  std::vector<double> means;
  for (const std::vector<double>& round : r.milliseconds) {
    means.push_back(std::inner_product(share.begin(), share.end(), round.begin(), 0.0));
  }
  return means;
}

json toJson(const CameraErrors& e) {
  return {{"scene", e.scene}, {"camera", e.camera},
          {"rmse", e.rmse},   {"mean_absolute", e.meanAbsolute},
          {"bias", e.bias},   {"percentile_99", e.percentile99},
          {"ssim", e.ssim}};
}

CameraErrors errorsFrom(const json& j) {
  return {j.at("scene"), j.at("camera"),        j.at("rmse"), j.at("mean_absolute"),
          j.at("bias"),  j.at("percentile_99"), j.at("ssim")};
}

}  // namespace

double medianOf(const std::vector<double>& values) {
  return quantile(values, 0.5);
}

std::vector<double> Record::shares() const {
  std::map<std::string, double> cameras;
  for (const CameraErrors& one : errors) ++cameras[one.scene];
  std::vector<double> shares;
  for (const CameraErrors& one : errors) {
    shares.push_back(1 / (cameras[one.scene] * static_cast<double>(cameras.size())));
  }
  return shares;
}

double Record::rmse() const {
  const std::vector<double> share = shares();
  double sum = 0;
  for (size_t i = 0; i < errors.size(); ++i) sum += share[i] * errors[i].rmse;
  return sum;
}

double Record::cost() const {
  return medianOf(roundsOf(*this));
}

double Record::spread() const {
  const std::vector<double> rounds = roundsOf(*this);
  return quantile(rounds, 0.75) - quantile(rounds, 0.25);
}

double Record::costOf(size_t camera) const {
  std::vector<double> values;
  for (const std::vector<double>& round : milliseconds) values.push_back(round[camera]);
  return medianOf(values);
}

fs::path fileOf(const fs::path& folder, const Record& record) {
  std::string key = record.study + "\n" + record.backend;
  for (const effect::Assignment& one : record.setting) key += "\n" + one.text();
  truth::ContentHash hash;
  hash.add(key);
  return folder / "records" / fmt::format("{:016x}.json", hash.value());
}

void save(const fs::path& folder, const Record& r) {
  json setting = json::array(), errors = json::array();
  for (const auto& [name, value] : r.setting) setting.push_back({name.text(), value});
  for (const CameraErrors& one : r.errors) errors.push_back(toJson(one));
  json all = {{"version", kVersion},  {"study", r.study},     {"setting", setting},
              {"backend", r.backend}, {"device", r.device},   {"driver", r.driver},
              {"clock", r.clock},     {"machine", r.machine}, {"commit", r.commit},
              {"command", r.command}, {"errors", errors},     {"milliseconds", r.milliseconds}};
  if (r.flicker) all["flicker"] = *r.flicker;
  if (r.pathRmse) all["path_rmse"] = *r.pathRmse;
  const fs::path file = fileOf(folder, r);
  std::error_code failed;
  fs::create_directories(file.parent_path(), failed);
  writeFileAtomically(file.string(), all.dump(1) + "\n");
}

std::optional<Record> load(const fs::path& file) {
  auto stream = openRegularFileIfThere(file, ErrorId::kStudyRecord);
  if (!stream) return std::nullopt;
  try {
    const json j = json::parse(*stream);
    if (j.at("version") != kVersion) {
      throw Error(ErrorId::kStudyRecord, "{} has version {}; this program reads version {}",
                  file.string(), j.at("version").dump(), kVersion);
    }
    Record r;
    r.study = j.at("study");
    for (const json& one : j.at("setting")) {
      const std::string name = one.at(0);
      r.setting.push_back({.name = effect::parseParameterName(name), .value = one.at(1)});
    }
    r.backend = j.at("backend");
    r.device = j.at("device");
    r.driver = j.at("driver");
    r.clock = j.at("clock");
    r.machine = j.at("machine");
    r.commit = j.at("commit");
    r.command = j.at("command");
    for (const json& one : j.at("errors")) r.errors.push_back(errorsFrom(one));
    r.milliseconds = j.at("milliseconds").get<std::vector<std::vector<double>>>();
    for (const std::vector<double>& round : r.milliseconds) {
      if (round.size() == r.errors.size()) continue;
      throw Error(ErrorId::kStudyRecord, "{} has a round of {} costs for {} cameras", file.string(),
                  round.size(), r.errors.size());
    }
    if (j.contains("flicker")) r.flicker = j["flicker"].get<double>();
    if (j.contains("path_rmse")) r.pathRmse = j["path_rmse"].get<double>();
    return r;
  } catch (const json::exception& error) {
    throw Error(ErrorId::kStudyRecord, "{}: {}", file.string(), error.what());
  }
}

std::vector<Record> loadAll(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code failed;
  for (fs::directory_iterator file(folder / "records", failed);
       !failed && file != fs::directory_iterator(); file.increment(failed)) {
    if (file->path().extension() == ".json") files.push_back(file->path());
  }
  std::ranges::sort(files);
  std::vector<Record> records;
  for (const fs::path& file : files) {
    if (auto record = load(file)) records.push_back(std::move(*record));
  }
  return records;
}

}  // namespace grisaille::app::study
