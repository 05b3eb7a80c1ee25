// SPDX-License-Identifier: MIT
#include "lab/stability/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "core/base/atomic_file.h"
#include "lab/stability/edge_pictures.h"

namespace grisaille::lab::stability {
namespace fs = std::filesystem;
using nlohmann::json;
namespace {

// The texts of all backends, or a single one if all are equal.
template <typename F>
std::string each(const Result& result, const F& text) {
  std::vector<std::string> texts;
  for (const BackendResult& b : result.backends) {
    texts.push_back(b.error.empty() ? text(b) : std::string("none"));
  }
  const bool same = std::ranges::all_of(texts, [&](const auto& t) { return t == texts[0]; });
  return same ? texts.at(0) : fmt::format("{}", fmt::join(texts, " / "));
}

// A difference in steps of an 8-bit picture.
std::string in255ths(double value) {
  return fmt::format("{:.2f}", 255 * value);
}

std::string percent(double share) {
  return fmt::format("{:.3g}", 100 * share);
}

std::string remarkOf(const Case& one, const Result& result) {
  std::vector<std::string> remarks;
  if (result.backends.at(0).leastOpen) {
    remarks.push_back("least visibility " + each(result, [](const BackendResult& b) {
                        return fmt::format("{:.3f}", b.leastOpen.value_or(0));
                      }));
  }
  if (result.backends.at(0).cornerError) {
    remarks.push_back("rms from the analytic value " + each(result, [](const BackendResult& b) {
                        return fmt::format("{:.4f}", b.cornerError.value_or(0));
                      }));
  }
  if (!one.edge.empty()) remarks.push_back("edge: " + one.edge);
  for (const std::string& fault : faultsOf(one, result)) remarks.push_back("**" + fault + "**");
  return fmt::format("{}", fmt::join(remarks, "; "));
}

std::string rowOf(const Case& one, const Result& result) {
  return fmt::format(
      "| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", one.name, one.variant,
      each(result, [](const auto& b) { return fmt::format("{:.0f}", 100 * b.touched); }),
      each(result, [](const auto& b) { return std::to_string(b.nonFinite); }),
      each(result, [](const auto& b) { return std::to_string(b.outside); }),
      each(result, [](const auto& b) { return in255ths(b.oracle.largest); }),
      each(result, [](const auto& b) { return in255ths(b.oracle.percentile99); }),
      each(result, [](const auto& b) { return percent(b.oracle.shareOver); }),
      result.between ? percent(result.between->shareOver) : "", remarkOf(one, result));
}

std::string edgesOf(const Sweep& sweep) {
  std::set<std::string> used;
  for (const Case& one : sweep.cases) used.insert(one.edge);
  std::string text, pictures;
  for (const Edge& edge : edges()) {
    if (!used.contains(edge.key)) continue;
    text += fmt::format("| {} | {} | {} |\n", edge.key, percent(edge.share), edge.why);
    const auto worst = worstOf(sweep, edge.key);
    if (!worst) continue;
    pictures +=
        fmt::format("\n{} ({}, {} % off):\n\n![{}]({})\n", edge.key, sweep.cases[*worst].title(),
                    percent(sweep.results[*worst].backends.at(0).oracle.shareOver), edge.key,
                    edgePictureName(edge.key));
  }
  if (text.empty()) return "";
  return "\n## Edges\n\nIn these cases more pixels may differ, because the method itself has a "
         "discontinuity. No arithmetic can remove it.\n\n| edge | at most, % | why "
         "|\n|---|---|---|\n" +
         text +
         "\nThe case of each edge that differs most: the effect's output, the oracle's, and black "
         "where they differ by over 2/255.\n" +
         pictures;
}

// The texts of all backends, or a single one if all are equal.
template <typename F>
std::string eachNow(const MovementRow& row, const F& text) {
  std::vector<std::string> texts;
  for (const Steadiness& now : row.now) texts.push_back(text(now));
  if (std::ranges::all_of(texts, [&](const auto& t) { return t == texts[0]; })) texts.resize(1);
  return fmt::format("{}", fmt::join(texts, " / "));
}

std::string movementsOf(const Sweep& sweep) {
  if (sweep.movements.empty()) return "";
  std::string text = fmt::format(
      "\n## Bias under a moving camera\n\n"
      "The classic estimator with a radius of 0.5 m sees a plane in the middle of a picture 720 "
      "pixels high. The camera moves slowly towards it, jitters by up to half a pixel, and "
      "turns.\n\n"
      "- Constant bias: the method of the literature, in double precision on the same depths and "
      "normals. The smallest safe bias keeps the plane over {} in every frame. The flicker is the "
      "rms change from frame to frame at the same place, at a bias of 0.01 m.\n"
      "- Effect: at a bias of 0, with a tolerance that follows from the roundings and slopes of "
      "its input. Its flicker must be at most {:.4f}.\n\n"
      "| angle to the plane | distance, m | constant bias: smallest safe bias, m | constant bias: "
      "flicker | effect: least visibility | dolly | jitter | turn | "
      "|\n|---|---|---|---|---|---|---|---|---|\n",
      kLeastOpen, kMostFlicker);
  for (const MovementRow& row : sweep.movements) {
    text += fmt::format("| {} | {} | {:.2g} | {:.4f} | {} |", row.degrees, row.distance,
                        row.safeBias, row.flickerAlone, eachNow(row, [](const Steadiness& now) {
                          return fmt::format("{:.3f}", now.leastOpen);
                        }));
    for (size_t i = 0; i < kMovements.size(); ++i) {
      text += fmt::format(" {} |", eachNow(row, [&](const Steadiness& now) {
                            return fmt::format("{:.4f}", now.flicker.at(i));
                          }));
    }
    text += fmt::format(" {} |\n", fmt::join(faultsOf(row), "; "));
  }
  return text;
}

std::string markdownOf(const Sweep& sweep) {
  std::string text = fmt::format(
      "# Numerical stability\n\nMade by `{}` at {} on {}.\n\n"
      "Each case is a scene, a camera and values at the limits of their ranges. The lab compares a "
      "shader's picture pixel by pixel with its oracle: the same algorithm in double precision, "
      "from the effect's definition, on the attachments that the shader read. The difference is "
      "the error of the arithmetic, not that of the method. A cell with "
      "one number holds for every backend, and a cell with two has one per backend:\n"
      "{}.\n\n"
      "A case holds if all values are finite and inside their range, and {} % of pixels are within "
      "2/255 of the oracle and of the other backend. The edges below allow more. Planes must have "
      "a visibility over {} everywhere. Right-angled corners must have an rms error of at most {}. "
      "**{} of {} cases hold.**\n",
      sweep.command, sweep.commit, sweep.machine, fmt::join(sweep.devices, " /\n"),
      100 * kShareWithin, kLeastOpen, kCornerError, sweep.count() - sweep.failed(), sweep.count());
  text += edgesOf(sweep);
  text += movementsOf(sweep);
  std::string group;
  for (size_t i = 0; i < sweep.cases.size(); ++i) {
    if (sweep.cases[i].group != group) {
      group = sweep.cases[i].group;
      text += fmt::format(
          "\n## {}\n\n| case | variant | touched, % | not finite | outside | largest, 1/255 | 99 "
          "%, 1/255 | "
          "over "
          "2/255, % | backends apart, % | |\n|---|---|---|---|---|---|---|---|---|---|\n",
          group);
    }
    text += rowOf(sweep.cases[i], sweep.results[i]);
  }
  return text;
}

std::string csvOf(const Sweep& sweep) {
  std::string text = "group,case,variant,edge,holds";
  if (sweep.results.empty()) return text + "\n";
  for (const BackendResult& b : sweep.results[0].backends) {
    for (const char* column : {"touched", "non_finite", "outside", "largest", "percentile_99",
                               "share_over", "least_open", "corner_error", "seconds"}) {
      text += fmt::format(",{}_{}", b.backend, column);
    }
  }
  text += ",apart_largest,apart_percentile_99,apart_share_over\n";
  const auto optional = [](const std::optional<double>& value) {
    return value ? fmt::format("{:.6g}", *value) : std::string();
  };
  for (size_t i = 0; i < sweep.cases.size(); ++i) {
    const Case& one = sweep.cases[i];
    const Result& result = sweep.results[i];
    text += fmt::format("\"{}\",\"{}\",\"{}\",\"{}\",{}", one.group, one.name, one.variant,
                        one.edge, faultsOf(one, result).empty() ? 1 : 0);
    for (const BackendResult& b : result.backends) {
      text += fmt::format(",{:.4g},{},{},{:.6g},{:.6g},{:.6g},{},{},{:.3f}", b.touched, b.nonFinite,
                          b.outside, b.oracle.largest, b.oracle.percentile99, b.oracle.shareOver,
                          optional(b.leastOpen), optional(b.cornerError), b.seconds);
    }
    if (result.between) {
      text += fmt::format(",{:.6g},{:.6g},{:.6g}\n", result.between->largest,
                          result.between->percentile99, result.between->shareOver);
    } else {
      text += ",,,\n";
    }
  }
  return text;
}

json jsonOf(const Apart& apart) {
  return {{"pixels", apart.pixels},
          {"largest", apart.largest},
          {"percentile_99", apart.percentile99},
          {"share_over", apart.shareOver}};
}

json jsonOf(const Case& one, const Result& result) {
  json backends = json::array();
  for (const BackendResult& b : result.backends) {
    json entry = {{"backend", b.backend},
                  {"touched", b.touched},
                  {"non_finite", b.nonFinite},
                  {"outside", b.outside},
                  {"bits", fmt::format("{:016x}", b.bits)},
                  {"oracle", jsonOf(b.oracle)}};
    if (!b.error.empty()) entry["error"] = b.error;
    if (b.leastOpen) entry["least_open"] = *b.leastOpen;
    if (b.cornerError) entry["corner_error"] = *b.cornerError;
    backends.push_back(entry);
  }
  json settings = json::object();
  for (const auto& [key, value] : one.settings) settings[key] = value;
  json all = {{"group", one.group},         {"case", one.name},
              {"variant", one.variant},     {"scene", nameOf(one.scenery.kind)},
              {"scale", one.scenery.scale}, {"size", {one.size.x, one.size.y}},
              {"effect", one.effect},       {"settings", settings},
              {"shots", one.shots.size()},  {"camera", json::parse(scene::cameraJson(one.camera))},
              {"backends", backends},       {"faults", faultsOf(one, result)}};
  if (!one.edge.empty()) all["edge"] = one.edge;
  if (result.between) all["between"] = jsonOf(*result.between);
  return all;
}

json jsonOf(const MovementRow& row) {
  json now = json::array();
  for (const Steadiness& one : row.now) {
    json entry = {{"backend", one.backend}, {"least_open", one.leastOpen}};
    for (const Movement movement : kMovements) {
      entry[std::string("flicker_") + nameOf(movement)] =
          one.flicker.at(static_cast<size_t>(movement));
    }
    now.push_back(entry);
  }
  return {{"degrees", row.degrees},
          {"distance", row.distance},
          {"safe_bias_alone", row.safeBias},
          {"flicker_alone", row.flickerAlone},
          {"now", now},
          {"faults", faultsOf(row)}};
}

}  // namespace

size_t Sweep::failed() const {
  size_t count = 0;
  for (size_t i = 0; i < cases.size(); ++i) count += faultsOf(cases[i], results[i]).empty() ? 0 : 1;
  for (const MovementRow& row : movements) count += faultsOf(row).empty() ? 0 : 1;
  return count;
}

void writeSweep(const std::string& folder, const Sweep& sweep) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  const auto write = [&](const char* name, const std::string& text) {
    writeFileAtomically((fs::path(folder) / name).string(), text);
  };
  json cases = json::array();
  for (size_t i = 0; i < sweep.cases.size(); ++i) {
    cases.push_back(jsonOf(sweep.cases[i], sweep.results[i]));
  }
  json movements = json::array();
  for (const MovementRow& row : sweep.movements) movements.push_back(jsonOf(row));
  const json all = {
      {"version", 1},           {"command", sweep.command}, {"machine", sweep.machine},
      {"commit", sweep.commit}, {"devices", sweep.devices}, {"cases", cases},
      {"movements", movements}};
  write("stability.json", all.dump(1) + "\n");
  write("stability.csv", csvOf(sweep));
  write("stability.md", markdownOf(sweep));
}

}  // namespace grisaille::lab::stability
