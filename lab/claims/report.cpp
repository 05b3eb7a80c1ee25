// SPDX-License-Identifier: MIT
#include "lab/claims/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "app/study/data_url.h"
#include "core/base/atomic_file.h"
#include "lab/claims/metrics.h"
#include "lab/claims/regions.h"

namespace grisaille::lab::claims {
namespace fs = std::filesystem;
using nlohmann::json;
namespace {

std::string numberText(double value) {
  return fmt::format("{:.3g}", value);
}

// The texts of all backends, or a single one if all are equal.
std::string onBackends(const std::vector<std::string>& texts) {
  const bool same = std::ranges::all_of(texts, [&](const auto& t) { return t == texts[0]; });
  return same ? texts[0] : fmt::format("{}", fmt::join(texts, " / "));
}

// The text that `f` returns for each backend's result of a claim.
template <typename F>
std::string each(const ClaimsReport& report, size_t claim, const F& f) {
  std::vector<std::string> texts;
  for (const ClaimsOfBackend& backend : report.backends) texts.push_back(f(backend.results[claim]));
  return onBackends(texts);
}

std::string backendNames(const ClaimsReport& report) {
  std::string names;
  for (const ClaimsOfBackend& b : report.backends)
    names += (names.empty() ? "" : " / ") + b.backend;
  return names;
}

using Rows = std::vector<std::vector<std::string>>;  // the first row is the header

// The settings and numbers of a claim's runs.
Rows numbersOf(const ClaimsReport& report, size_t claim) {
  const ClaimResult& first = report.backends[0].results[claim];
  Rows rows = {{"run", "settings"}};
  for (const auto& [quantity, value] : first.values.begin()->second) rows[0].push_back(quantity);
  for (const ClaimRun& run : report.file.claims[claim].runs) {
    std::string settings;
    const auto add = [&](const std::string& text) {
      settings += (settings.empty() ? "" : ", ") + text;
    };
    for (const std::string& preset : run.presets) add("preset " + preset);
    for (const std::string& set : run.sets) add(set);
    if (run.shots != report.file.claims[claim].shots.size())
      add(fmt::format("{} shots", run.shots));
    if (run.screenNoise) add("splats fixed to the screen");
    if (!run.against.empty()) add("errors against " + run.against);
    rows.push_back({run.name, settings});
    for (const auto& [quantity, value] : first.values.begin()->second) {
      rows.back().push_back(each(report, claim, [&, &name = quantity](const ClaimResult& result) {
        return numberText(result.values.at(run.name).at(name));
      }));
    }
  }
  return rows;
}

Rows expectationsOf(const ClaimsReport& report, size_t claim) {
  Rows rows = {{"expected", "left", "right", ""}};
  const std::vector<Expectation>& all = report.file.claims[claim].expectations;
  for (size_t i = 0; i < all.size(); ++i) {
    const auto text = [&](const auto& f) {
      return each(report, claim, [&](const ClaimResult& r) { return f(r.expectations[i]); });
    };
    const double factor = all[i].right ? all[i].factor : 1;
    rows.push_back({all[i].text, text([](const auto& e) { return numberText(e.left); }),
                    text([&](const auto& e) { return numberText(factor * e.right); }),
                    text([](const auto& e) -> std::string { return e.holds ? "yes" : "no"; })});
  }
  return rows;
}

Rows verdictsOf(const ClaimsReport& report) {
  Rows rows = {{"claim", "statement", backendNames(report)}};
  for (size_t i = 0; i < report.file.claims.size(); ++i) {
    const Claim& claim = report.file.claims[i];
    rows.push_back({claim.key, claim.text, each(report, i, [](const ClaimResult& r) -> std::string {
                      return verdictOf(r);
                    })});
  }
  return rows;
}

// The meanings of the metrics and regions that the claims use.
Rows meaningsOf(const ClaimsReport& report) {
  std::set<std::string> used;
  for (const Claim& claim : report.file.claims) {
    for (const Expectation& e : claim.expectations) {
      for (const Term* term : {&e.left, e.right ? &*e.right : nullptr}) {
        if (term == nullptr) continue;
        used.insert(term->metric);
        for (const RegionInfo& region : regions()) {
          const std::string in = "+" + term->region + "+";
          if (in.find(fmt::format("+{}+", region.key)) != std::string::npos) {
            used.insert(fmt::format("@{}", region.key));
          }
        }
      }
    }
  }
  Rows rows = {{"name", "meaning"}};
  for (const MetricInfo& metric : metrics()) {
    if (used.contains(metric.key)) rows.push_back({metric.key, metric.meaning});
  }
  for (const RegionInfo& region : regions()) {
    const std::string name = fmt::format("@{}", region.key);
    if (used.contains(name)) rows.push_back({name, region.meaning});
  }
  return rows;
}

std::string aboutOf(const ClaimsReport& report) {
  std::string text;
  for (const ClaimsOfBackend& b : report.backends) {
    text += fmt::format("{}: {} ({}), {} clock. ", b.backend, b.device, b.driver, b.clock);
  }
  return text + fmt::format("{}. Commit {}.", report.machine, report.commit);
}

std::string pictureFile(const Claim& claim, size_t row, const std::string& name) {
  const std::string number = row == 0 ? "" : fmt::format("-{}", row + 1);
  return fmt::format("pictures/claims/{}-{}{}.png", claim.key, name, name == "truth" ? number : "");
}

// The markup of a report: Markdown or HTML.
class Markup {
 public:
  virtual ~Markup() = default;
  virtual std::string heading(int level, const std::string& text) const = 0;
  virtual std::string paragraph(const std::string& text) const = 0;
  virtual std::string code(const std::string& text) const = 0;
  virtual std::string table(const Rows& rows) const = 0;
  virtual std::string picture(const std::string& file, const ClaimPicture& picture) const = 0;
  virtual std::string pictures(const Rows& rows) const { return table(rows); }
};

class Markdown : public Markup {
 public:
  std::string heading(int level, const std::string& text) const override {
    return std::string(static_cast<size_t>(level), '#') + " " + text + "\n\n";
  }
  std::string paragraph(const std::string& text) const override { return text + "\n\n"; }
  std::string code(const std::string& text) const override { return "```\n" + text + "\n```\n\n"; }
  std::string table(const Rows& rows) const override {
    std::string text;
    for (const auto& row : rows) {
      text += fmt::format("| {} |\n", fmt::join(row, " | "));
      if (&row != &rows[0]) continue;
      for (size_t i = 0; i < row.size(); ++i) text += "|---";
      text += "|\n";
    }
    return text + "\n";
  }
  std::string picture(const std::string& file, const ClaimPicture& picture) const override {
    return fmt::format("![{}]({})", picture.name, file);
  }
};

class Html : public Markup {
 public:
  std::string heading(int level, const std::string& text) const override {
    return fmt::format("<h{0}>{1}</h{0}>\n", level, escaped(text));
  }
  std::string paragraph(const std::string& text) const override {
    return "<p>" + escaped(text) + "</p>\n";
  }
  std::string code(const std::string& text) const override {
    return "<pre>" + escaped(text) + "</pre>\n";
  }
  std::string table(const Rows& rows) const override { return cells(rows, true); }
  std::string picture(const std::string&, const ClaimPicture& picture) const override {
    return fmt::format("<img alt=\"{}\" src=\"{}\">", picture.name,
                       app::study::dataUrl("image/png", image::encodePng(picture.picture)));
  }
  std::string pictures(const Rows& rows) const override { return cells(rows, false); }

 private:
  static std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
      if (c == '&') {
        result += "&amp;";
      } else if (c == '<') {
        result += "&lt;";
      } else {
        result += c;
      }
    }
    return result;
  }
  static std::string cells(const Rows& rows, bool text) {
    std::string html = "<table>\n";
    for (const auto& row : rows) {
      const bool head = &row == &rows[0];
      html += "<tr>";
      for (const std::string& cell : row) {
        html +=
            fmt::format("<{0}>{1}</{0}>", head ? "th" : "td", head || text ? escaped(cell) : cell);
      }
      html += "</tr>\n";
    }
    return html + "</table>\n";
  }
};

// A caption that explains the pictures; "" if none is needed.
std::string captionOf(const Claim& claim) {
  const PictureDesc& desc = claim.picture;
  if (desc.show == PictureKind::kChange) {
    return fmt::format(
        "Pictures: change from the first frame to the second at the same point of the world. "
        "Orange is more, blue is less; the colour is full at {}.",
        desc.high);
  }
  if (!claim.shots.empty())
    return "Pictures: in the truth, white is the ray-traced mask of the paint.";
  if (desc.low == 0 && desc.high == 1) return "";
  return fmt::format("Pictures: {} is black and {} white.", desc.low, desc.high);
}

std::string claimText(const ClaimsReport& report, size_t index, const Markup& markup) {
  const Claim& claim = report.file.claims[index];
  std::string text = markup.heading(2, claim.key) + markup.paragraph(claim.text);
  text += markup.paragraph("Source: " + claim.source);
  text += markup.paragraph(fmt::format(
      "Measured ({}): {}. {}", backendNames(report),
      each(report, index, [](const ClaimResult& r) -> std::string { return verdictOf(r); }),
      claim.note));
  text += markup.table(expectationsOf(report, index));
  text += markup.table(numbersOf(report, index));
  if (!captionOf(claim).empty()) text += markup.paragraph(captionOf(claim));
  const std::vector<PictureRow>& rows = report.backends[0].results[index].pictures;
  for (size_t r = 0; r < rows.size(); ++r) {
    Rows table(2);
    for (const ClaimPicture& picture : rows[r]) {
      table[0].push_back(picture.name);
      table[1].push_back(markup.picture(pictureFile(claim, r, picture.name), picture));
    }
    text += markup.pictures(table);
  }
  return text;
}

std::string reportText(const ClaimsReport& report, const Markup& markup) {
  std::string text = markup.heading(1, report.file.title) + markup.paragraph("Made by") +
                     markup.code(report.command) + markup.paragraph(aboutOf(report)) +
                     markup.table(verdictsOf(report));
  for (size_t i = 0; i < report.file.claims.size(); ++i) text += claimText(report, i, markup);
  return text + markup.heading(2, "Metrics and regions") + markup.table(meaningsOf(report));
}

json jsonOf(const ClaimsReport& report) {
  json backends = json::array();
  for (const ClaimsOfBackend& backend : report.backends) {
    json claims = json::array();
    for (size_t i = 0; i < backend.results.size(); ++i) {
      const Claim& claim = report.file.claims[i];
      const ClaimResult& result = backend.results[i];
      json expectations = json::array();
      for (size_t k = 0; k < result.expectations.size(); ++k) {
        const ExpectationResult& e = result.expectations[k];
        expectations.push_back({{"text", claim.expectations[k].text},
                                {"left", e.left},
                                {"right", e.right},
                                {"holds", e.holds},
                                {"timed", e.timed}});
      }
      claims.push_back({{"key", claim.key},
                        {"text", claim.text},
                        {"source", claim.source},
                        {"verdict", verdictOf(result)},
                        {"values", result.values},
                        {"expectations", expectations}});
    }
    backends.push_back({{"backend", backend.backend},
                        {"device", backend.device},
                        {"driver", backend.driver},
                        {"clock", backend.clock},
                        {"claims", claims}});
  }
  return {{"title", report.file.title},
          {"command", report.command},
          {"machine", report.machine},
          {"commit", report.commit},
          {"backends", backends}};
}

}  // namespace

const char* verdictOf(const ClaimResult& result) {
  return result.holds() ? "holds" : "does not hold";
}

void writeClaims(const fs::path& folder, const ClaimsReport& report) {
  std::error_code failed;
  fs::create_directories(folder / "pictures/claims", failed);
  for (size_t i = 0; i < report.file.claims.size(); ++i) {
    const std::vector<PictureRow>& rows = report.backends[0].results[i].pictures;
    for (size_t r = 0; r < rows.size(); ++r) {
      for (const ClaimPicture& picture : rows[r]) {
        const std::vector<std::byte> png = image::encodePng(picture.picture);
        writeFileAtomically((folder / pictureFile(report.file.claims[i], r, picture.name)).string(),
                            {reinterpret_cast<const char*>(png.data()), png.size()});
      }
    }
  }
  constexpr const char* kStyle =
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Claims</title>"
      "<style>body{font:15px sans-serif;margin:1.5em;max-width:1400px}"
      "td,th{padding:.2em .7em;text-align:left;vertical-align:top;border-bottom:1px solid #ddd}"
      "img{max-width:100%;image-rendering:pixelated}pre{background:#eee;padding:.6em}"
      "</style></head><body>\n";
  writeFileAtomically((folder / "claims.html").string(),
                      kStyle + reportText(report, Html()) + "</body></html>\n");
  writeFileAtomically((folder / "claims.md").string(), reportText(report, Markdown()));
  writeFileAtomically((folder / "claims.json").string(), jsonOf(report).dump(1) + "\n");
}

}  // namespace grisaille::lab::claims
