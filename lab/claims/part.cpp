// SPDX-License-Identifier: MIT
#include "lab/claims/part.h"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "app/truth/content_hash.h"
#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/regular_file.h"

namespace grisaille::lab::claims {
namespace fs = std::filesystem;
using nlohmann::json;
namespace {

fs::path partOf(const fs::path& folder, const std::string& key) {
  app::truth::ContentHash hash;
  hash.add(key);
  return folder / fmt::format("{:016x}.cbor", hash.value());
}

json toJson(const ExpectationResult& e) {
  return {{"left", e.left}, {"right", e.right}, {"holds", e.holds}, {"timed", e.timed}};
}

json toJson(const ClaimPicture& one) {
  return {{"name", one.name},
          {"width", one.picture.width},
          {"height", one.picture.height},
          {"pixels", json::binary(one.picture.pixels)}};
}

ClaimPicture pictureFrom(const json& j) {
  ClaimPicture one{.name = j.at("name"), .picture = {}};
  one.picture.width = j.at("width");
  one.picture.height = j.at("height");
  one.picture.pixels = j.at("pixels").get_binary();
  return one;
}

}  // namespace

void saveClaim(const fs::path& folder, const std::string& key, const ClaimResult& result) {
  json all = {{"key", key}, {"values", result.values}};
  all["expectations"] = json::array();
  for (const ExpectationResult& one : result.expectations)
    all["expectations"].push_back(toJson(one));
  all["pictures"] = json::array();
  for (const PictureRow& row : result.pictures) {
    json pictures = json::array();
    for (const ClaimPicture& one : row) pictures.push_back(toJson(one));
    all["pictures"].push_back(pictures);
  }
  const std::vector<uint8_t> bytes = json::to_cbor(all);
  std::error_code failed;
  fs::create_directories(folder, failed);  // on failure, the next line throws
  writeFileAtomically(partOf(folder, key).string(),
                      {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

std::optional<ClaimResult> loadClaim(const fs::path& folder, const std::string& key) {
  auto stream = openRegularFileIfThere(partOf(folder, key), ErrorId::kStudyRecord);
  if (!stream) return std::nullopt;
  try {
    const json j = json::from_cbor(*stream);
    if (j.at("key") != key) return std::nullopt;
    ClaimResult result;
    result.values = j.at("values").get<decltype(result.values)>();
    for (const json& one : j.at("expectations")) {
      result.expectations.push_back({.left = one.at("left"),
                                     .right = one.at("right"),
                                     .holds = one.at("holds"),
                                     .timed = one.at("timed")});
    }
    for (const json& row : j.at("pictures")) {
      PictureRow& pictures = result.pictures.emplace_back();
      for (const json& one : row) pictures.push_back(pictureFrom(one));
    }
    return result;
  } catch (const json::exception&) {
    return std::nullopt;  // damaged: the claim is measured again
  }
}

}  // namespace grisaille::lab::claims
