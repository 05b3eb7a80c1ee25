// SPDX-License-Identifier: MIT
#include "app/study/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>

#include "app/study/page.h"
#include "core/base/atomic_file.h"
#include "core/base/quote.h"

namespace grisaille::app::study {
namespace fs = std::filesystem;
namespace {

// Plot data for gnuplot: cost and error of each chosen record.
std::string rows(std::span<const Record> records, const std::vector<size_t>& chosen) {
  std::string text;
  for (const size_t i : chosen)
    text += fmt::format("{} {}\n", records[i].cost(), records[i].rmse());
  return text + "e\n";
}

// One price per record. The cost is 0 for records of other backends and incomplete records.
std::vector<Price> pricesOn(std::span<const Record> records, const std::string& backend) {
  std::vector<Price> prices;
  for (const Record& r : records) {
    const bool known = r.backend == backend && !r.errors.empty();
    prices.push_back({.cost = known ? r.cost() : 0, .error = r.rmse()});
  }
  return prices;
}

// A gnuplot script that draws front.svg and front.png; "" if nothing is measured.
std::string plotScript(const fs::path& folder, std::span<const Record> records) {
  constexpr const char* kColours[] = {"#0072B2", "#D55E00"};
  std::string script =
      "set logscale x\nset xlabel 'cost of the effects, ms'\n"
      "set ylabel 'RMSE against ray-traced truth'\nset grid\nset key top right noenhanced\n";
  const std::vector<Kind> kinds = kindsOf(records);
  std::string plot = "plot ", data;
  size_t number = 0;
  for (const std::string& backend : backendsOf(records)) {
    std::vector<size_t> all;
    for (size_t i = 0; i < records.size(); ++i) {
      const Record& r = records[i];
      if (r.backend == backend && r.cost() > 0 && !r.errors.empty()) all.push_back(i);
    }
    if (all.empty()) continue;
    const char* colour = kColours[number++ % std::size(kColours)];
    plot += fmt::format(
        "{}'-' with points pt 7 ps 0.5 lc rgb '{}' title '{}', "
        "'-' with linespoints pt 7 lw 2 lc rgb '{}' title '{}: front'",
        number > 1 ? ", " : "", colour, backend, colour, backend);
    data += rows(records, all) + rows(records, paretoFront(records, backend));
    for (const Kind& kind : kinds) {
      const std::vector<size_t> own = ownFront(records, backend, kind);
      if (own.empty()) continue;
      plot += fmt::format(", '-' with linespoints pt 7 ps 0.5 dt 2 lc rgb '{}' title '{}: {}'",
                          colour, backend, kind.name);
      data += rows(records, own);
    }
  }
  if (number == 0) return "";
  for (const auto& [terminal, file] :
       {std::pair{"svg size 900,600", "front.svg"}, {"pngcairo size 1200,800", "front.png"}}) {
    script += fmt::format("set terminal {}\nset output '{}'\n{}\n{}", terminal,
                          (folder / file).string(), plot, data);
  }
  return script;
}

// The mean errors over a record's cameras, by Record::shares().
CameraErrors meanOf(const Record& r) {
  CameraErrors mean;
  const std::vector<double> shares = r.shares();
  for (size_t i = 0; i < r.errors.size(); ++i) {
    const CameraErrors& e = r.errors[i];
    const double share = shares[i];
    mean.rmse += share * e.rmse;
    mean.meanAbsolute += share * e.meanAbsolute;
    mean.bias += share * e.bias;
    mean.percentile99 += share * e.percentile99;
    mean.ssim += share * e.ssim;
  }
  return mean;
}

// Every parameter that a setting names, in the order of first occurrence.
std::vector<std::string> parametersOf(std::span<const Record> records) {
  std::vector<std::string> names;
  for (const Record& r : records) {
    for (const effect::Assignment& one : r.setting) {
      const std::string name = one.name.text();
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    }
  }
  return names;
}

// "SCENE/CAMERA"; "CAMERA" in a study of one scene.
std::string placeOf(const CameraErrors& e) {
  return e.scene.empty() ? e.camera : e.scene + "/" + e.camera;
}

std::vector<std::string> camerasOf(std::span<const Record> records) {
  std::vector<std::string> names;
  for (const Record& r : records) {
    for (const CameraErrors& e : r.errors) {
      if (std::ranges::find(names, placeOf(e)) == names.end()) names.push_back(placeOf(e));
    }
  }
  return names;
}

std::string textOf(std::optional<double> value) {
  return value ? fmt::format("{}", *value) : std::string();
}

std::string csvOf(std::span<const Record> records) {
  const std::vector<std::string> parameters = parametersOf(records);
  std::string csv = "backend,device,clock";
  for (const std::string& name : parameters) csv += "," + name;
  csv += ",milliseconds,spread,rounds,rmse,mean_absolute,bias,percentile_99,ssim,flicker,path_rmse";
  const std::vector<std::string> cameras = camerasOf(records);
  for (const std::string& camera : cameras) csv += ",rmse of " + camera;
  for (const std::string& camera : cameras) csv += ",milliseconds of " + camera;
  csv += ",commit\n";
  for (const Record& r : records) {
    csv += fmt::format("{},\"{}\",{}", r.backend, r.device, r.clock);
    for (const std::string& name : parameters) {
      const auto own = std::ranges::find_if(
          r.setting, [&](const effect::Assignment& one) { return one.name.text() == name; });
      csv += "," + (own == r.setting.end() ? std::string() : own->value);
    }
    const CameraErrors mean = meanOf(r);
    csv += fmt::format(",{:.4f},{:.4f},{},{},{},{},{},{},{},{}", r.cost(), r.spread(),
                       r.milliseconds.size(), mean.rmse, mean.meanAbsolute, mean.bias,
                       mean.percentile99, mean.ssim, textOf(r.flicker), textOf(r.pathRmse));
    const auto addCameras = [&](const auto& valueOf) {
      for (const std::string& camera : cameras) {
        const auto own = std::ranges::find(r.errors, camera, placeOf);
        csv += ",";
        if (own != r.errors.end()) csv += valueOf(static_cast<size_t>(own - r.errors.begin()));
      }
    };
    addCameras([&](size_t i) { return fmt::format("{}", r.errors[i].rmse); });
    addCameras([&](size_t i) { return fmt::format("{:.4f}", r.costOf(i)); });
    csv += "," + r.commit + "\n";
  }
  return csv;
}

}  // namespace

std::vector<std::string> backendsOf(std::span<const Record> records) {
  std::vector<std::string> names;
  for (const Record& record : records) {
    if (std::ranges::find(names, record.backend) == names.end()) names.push_back(record.backend);
  }
  std::ranges::sort(names);
  return names;
}

std::vector<size_t> frontOf(std::span<const Price> prices) {
  std::vector<size_t> order;
  for (size_t i = 0; i < prices.size(); ++i) {
    if (prices[i].cost > 0) order.push_back(i);
  }
  std::ranges::sort(order, {},
                    [&](size_t i) { return std::pair(prices[i].cost, prices[i].error); });
  std::vector<size_t> front;
  for (const size_t i : order) {
    if (front.empty() || prices[i].error < prices[front.back()].error) front.push_back(i);
  }
  return front;
}

std::vector<size_t> paretoFront(std::span<const Record> records, const std::string& backend) {
  return frontOf(pricesOn(records, backend));
}

std::vector<Kind> kindsOf(std::span<const Record> records) {
  std::vector<std::pair<std::vector<std::string>, Kind>> kinds;
  std::vector<SettingText> shared;  // the values that all settings of a kind share
  const auto keepShared = [](SettingText& all, const SettingText& one) {
    std::erase_if(all, [&](const auto& value) { return !std::ranges::count(one, value); });
  };
  SettingText everywhere = records.empty() ? SettingText() : records.front().setting;
  for (size_t i = 0; i < records.size(); ++i) {
    const SettingText& setting = records[i].setting;
    std::vector<std::string> names;
    for (const effect::Assignment& one : setting) names.push_back(one.name.text());
    std::ranges::sort(names);
    auto own = std::ranges::find(kinds, names, [](const auto& kind) { return kind.first; });
    if (own == kinds.end()) {
      shared.push_back(setting);
      own = kinds.insert(kinds.end(), {names, {}});
    }
    own->second.records.push_back(i);
    keepShared(shared[static_cast<size_t>(own - kinds.begin())], setting);
    keepShared(everywhere, setting);
  }
  std::vector<Kind> all;
  for (size_t k = 0; k < kinds.size(); ++k) {
    std::erase_if(shared[k], [&](const auto& v) { return std::ranges::count(everywhere, v) > 0; });
    kinds[k].second.name =
        shared[k].empty() ? fmt::to_string(fmt::join(kinds[k].first, ", ")) : nameOf(shared[k]);
    all.push_back(std::move(kinds[k].second));
  }
  return all;
}

std::vector<size_t> ownFront(std::span<const Record> records, const std::string& backend,
                             const Kind& kind) {
  const std::vector<Price> all = pricesOn(records, backend);
  std::vector<Price> prices(all.size());
  for (const size_t i : kind.records) prices[i] = all[i];
  const std::vector<size_t> own = frontOf(prices), whole = frontOf(all);
  const auto isOnWhole = [&](size_t i) { return std::ranges::count(whole, i) > 0; };
  return std::ranges::all_of(own, isOnWhole) ? std::vector<size_t>() : own;
}

void writeReport(const fs::path& folder) {
  const std::vector<Record> records = loadAll(folder);
  writeFileAtomically((folder / "results.csv").string(), csvOf(records));
  writeFileAtomically((folder / "results.json").string(), resultsOf(records));
  writeFileAtomically((folder / "index.html").string(), pageOf(folder, records));
  const std::string script = plotScript(folder, records);
  if (script.empty()) return;
  const fs::path file = folder / "front.gp";
  writeFileAtomically(file.string(), script);
  const std::string command = "gnuplot " + shellQuoted(file.string());
  if (std::system(command.c_str()) != 0) {
    fmt::print(stderr, "note: no plots: gnuplot failed or is not installed\n");
  }
}

}  // namespace grisaille::app::study
