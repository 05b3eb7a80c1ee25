// SPDX-License-Identifier: MIT
#include "app/study/page.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/study/data_url.h"
#include "app/study/page_html.h"
#include "app/study/report.h"
#include "app/study/study.h"
#include "core/image/image.h"

namespace grisaille::app::study {
namespace fs = std::filesystem;
using nlohmann::json;
namespace {

// The picture as a JPEG data URL, small because a page holds hundreds of pictures. "" if the file
// does not exist.
std::string pictureUrl(const fs::path& file) {
  constexpr int kQuality = 85;
  if (!fs::exists(file)) return "";
  return dataUrl("image/jpeg", image::encodeJpeg(image::read(file.string()), kQuality));
}

json jsonOf(const Record& r) {
  json setting = json::object(), errors = json::array();
  for (const auto& [name, value] : r.setting) setting[name.text()] = value;
  const std::vector<double> shares = r.shares();
  for (size_t i = 0; i < r.errors.size(); ++i) {
    const CameraErrors& e = r.errors[i];
    errors.push_back({{"scene", e.scene},
                      {"camera", e.camera},
                      {"share", shares[i]},
                      {"cost", r.costOf(i)},
                      {"rmse", e.rmse},
                      {"mean_absolute", e.meanAbsolute},
                      {"bias", e.bias},
                      {"percentile_99", e.percentile99},
                      {"ssim", e.ssim}});
  }
  json all = {{"name", nameOf(r.setting)}, {"setting", setting},
              {"backend", r.backend},      {"device", r.device},
              {"driver", r.driver},        {"clock", r.clock},
              {"machine", r.machine},      {"commit", r.commit},
              {"command", r.command},      {"errors", errors},
              {"rmse", r.rmse()},          {"cost", r.cost()},
              {"spread", r.spread()},      {"milliseconds", r.milliseconds}};
  if (r.flicker) all["flicker"] = *r.flicker;
  if (r.pathRmse) all["path_rmse"] = *r.pathRmse;
  return all;
}

}  // namespace

std::string resultsOf(std::span<const Record> records) {
  json all = json::array();
  for (const Record& r : records) all.push_back(jsonOf(r));
  for (const std::string& backend : backendsOf(records)) {
    for (const size_t i : paretoFront(records, backend)) all[i]["front"] = true;
  }
  return all.dump(1) + "\n";
}

std::string pageOf(const fs::path& folder, std::span<const Record> records) {
  json all = json::array(), kinds = json::array();
  for (const Kind& kind : kindsOf(records)) {
    kinds.push_back({{"name", kind.name}, {"records", kind.records}});
  }
  for (const Record& r : records) {
    json one = jsonOf(r);
    one["picture"] = pictureUrl(pictureOf(folder, r));
    one["error_map"] = pictureUrl(errorMapOf(folder, r));
    all.push_back(std::move(one));
  }
  std::string data =
      json{{"records", all}, {"kinds", kinds}, {"truth", pictureUrl(truthPictureOf(folder))}}
          .dump();
  // The data must not contain "</script>", which would end the script element.
  for (size_t at = 0; (at = data.find("</", at)) != std::string::npos; at += 3) {
    data.replace(at, 2, "<\\/");
  }
  std::string page = kPage;
  page.replace(page.find("@DATA@"), 6, data);
  return page;
}

}  // namespace grisaille::app::study
