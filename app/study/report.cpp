// SPDX-License-Identifier: MIT
#include "app/study/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>

#include "app/study/page.h"
#include "app/viewer/command_line.h"
#include "core/image/write_aside.h"

namespace grisaille::app::study {
namespace fs = std::filesystem;
namespace {

// Of one backend, for a plot: cost, error.
std::string rows(std::span<const Record> records, const std::vector<size_t>& chosen) {
  std::string text;
  for (const size_t i : chosen)
    text += fmt::format("{} {}\n", records[i].cost(), records[i].rmse());
  return text + "e\n";
}

std::vector<std::string> backendsOf(std::span<const Record> records) {
  std::vector<std::string> names;
  for (const Record& record : records) {
    if (std::ranges::find(names, record.backend) == names.end()) names.push_back(record.backend);
  }
  std::ranges::sort(names);
  return names;
}

std::vector<Record> ofBackend(std::span<const Record> records, const std::string& backend) {
  std::vector<Record> chosen;
  std::ranges::copy_if(records, std::back_inserter(chosen),
                       [&](const Record& r) { return r.backend == backend; });
  return chosen;
}

// A script that draws both pictures.
std::string plotScript(const fs::path& folder, std::span<const Record> records) {
  constexpr const char* kColours[] = {"#0072B2", "#D55E00"};
  std::string script =
      "set logscale x\nset xlabel 'cost of the effects, ms'\n"
      "set ylabel 'RMSE against ray-traced truth'\nset grid\nset key top right\n";
  std::string plot = "plot ", data;
  size_t number = 0;
  for (const std::string& backend : backendsOf(records)) {
    const std::vector<Record> own = ofBackend(records, backend);
    std::vector<size_t> all;
    for (size_t i = 0; i < own.size(); ++i) {
      if (own[i].cost() > 0 && !own[i].errors.empty()) all.push_back(i);
    }
    if (all.empty()) continue;
    const char* colour = kColours[number++ % std::size(kColours)];
    plot += fmt::format(
        "{}'-' with points pt 7 ps 0.5 lc rgb '{}' title '{}', "
        "'-' with linespoints pt 7 lw 2 lc rgb '{}' title '{}: front'",
        number > 1 ? ", " : "", colour, backend, colour, backend);
    data += rows(own, all) + rows(own, paretoFront(own));
  }
  if (number == 0) return "";
  for (const auto& [terminal, file] :
       {std::pair{"svg size 900,600", "front.svg"}, {"pngcairo size 1200,800", "front.png"}}) {
    script += fmt::format("set terminal {}\nset output '{}'\n{}\n{}", terminal,
                          (folder / file).string(), plot, data);
  }
  return script;
}

std::string csvOf(std::span<const Record> records) {
  std::string names;
  if (!records.empty()) {
    for (const auto& [name, value] : records[0].setting) names += "," + name;
  }
  std::string csv =
      "backend,device,clock" + names +
      ",milliseconds,spread,rounds,rmse,mean_absolute,bias,percentile_99,ssim,flicker,commit\n";
  for (const Record& r : records) {
    CameraErrors mean;
    for (const CameraErrors& e : r.errors) {
      const double share = 1 / static_cast<double>(r.errors.size());
      mean.rmse += share * e.rmse;
      mean.meanAbsolute += share * e.meanAbsolute;
      mean.bias += share * e.bias;
      mean.percentile99 += share * e.percentile99;
      mean.ssim += share * e.ssim;
    }
    csv += fmt::format("{},\"{}\",{}", r.backend, r.device, r.clock);
    for (const auto& [name, value] : r.setting) csv += "," + value;
    csv += fmt::format(",{:.4f},{:.4f},{},{},{},{},{},{},{},{}\n", r.cost(), r.spread(),
                       r.milliseconds.size(), mean.rmse, mean.meanAbsolute, mean.bias,
                       mean.percentile99, mean.ssim, r.flicker ? fmt::format("{}", *r.flicker) : "",
                       r.commit);
  }
  return csv;
}

}  // namespace

std::vector<size_t> paretoFront(std::span<const Record> records) {
  std::vector<size_t> order;
  for (size_t i = 0; i < records.size(); ++i) {
    if (!records[i].errors.empty() && !records[i].milliseconds.empty()) order.push_back(i);
  }
  std::ranges::sort(order, [&](size_t a, size_t b) {
    return std::pair(records[a].cost(), records[a].rmse()) <
           std::pair(records[b].cost(), records[b].rmse());
  });
  std::vector<size_t> front;
  for (const size_t i : order) {
    if (front.empty() || records[i].rmse() < records[front.back()].rmse()) front.push_back(i);
  }
  return front;
}

void writeReport(const fs::path& folder) {
  const std::vector<Record> records = loadAll(folder);
  image::writeFileAside((folder / "results.csv").string(), csvOf(records));
  const std::string page = pageOf(folder, records);
  image::writeFileAside((folder / "results.json").string(), pageData(folder, records, false));
  image::writeFileAside((folder / "index.html").string(), page);
  const std::string script = plotScript(folder, records);
  if (script.empty()) return;
  const fs::path file = folder / "front.gp";
  image::writeFileAside(file.string(), script);
  const std::string command = "gnuplot " + viewer::shellQuoted(file.string());
  if (std::system(command.c_str()) != 0) {
    fmt::print(stderr, "note: no plots: gnuplot fails or is not installed\n");
  }
}

}  // namespace grisaille::app::study
