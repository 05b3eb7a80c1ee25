// SPDX-License-Identifier: MIT
// The presets in the tree are what the study in the tree says, and what it says is still so.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <sstream>

#include "app/study/choose.h"
#include "core/image/image.h"
#include "tests/program/run.h"

namespace grisaille::app::study {
namespace {

namespace fs = std::filesystem;
using tests::readFile;
using tests::TemporaryFolder;

const fs::path kSource = SOURCE_FOLDER;

struct Row {
  Record record;
  double ofFirst = 0;  // RMSE of the first camera
};

// A study's results.csv.
std::vector<Row> readStudy(const fs::path& file) {
  std::istringstream text(readFile(file));
  const auto cells = [](const std::string& line) {
    std::vector<std::string> all(1);
    bool quoted = false;
    for (const char c : line) {
      if (c == '"') {
        quoted = !quoted;
      } else if (c == ',' && !quoted) {
        all.emplace_back();
      } else {
        all.back() += c;
      }
    }
    return all;
  };
  std::string line;
  std::getline(text, line);
  const std::vector<std::string> names = cells(line);
  std::vector<Row> rows;
  while (std::getline(text, line)) {
    const std::vector<std::string> values = cells(line);
    EXPECT_EQ(values.size(), names.size());
    Row row;
    std::map<std::string, std::string> all;
    for (size_t i = 0; i < names.size(); ++i) {
      all[names[i]] = values[i];
      if (names[i].find('.') != std::string::npos && !values[i].empty()) {
        row.record.setting.emplace_back(names[i], values[i]);
      }
      if (row.ofFirst == 0 && names[i].rfind("rmse of ", 0) == 0)
        row.ofFirst = std::stod(values[i]);
    }
    row.record.study = "size 640x360\n";
    row.record.backend = all.at("backend");
    row.record.milliseconds = {std::stod(all.at("milliseconds"))};
    row.record.errors = {{"mean", std::stod(all.at("rmse")), 0, 0, 0, 1}};
    rows.push_back(row);
  }
  return rows;
}

std::string withoutFirstLine(const std::string& text) {
  return text.substr(text.find('\n') + 1);
}

class Front : public testing::TestWithParam<const char*> {
 protected:
  fs::path study() const { return kSource / "studies" / (std::string(GetParam()) + ".csv"); }
  std::string presets() const {
    return readFile(kSource / "effects" / GetParam() / "presets.toml");
  }
};

TEST_P(Front, PresetsAreOnIt) {
  const TemporaryFolder folder;
  std::vector<Record> records;
  for (const Row& row : readStudy(study())) records.push_back(row.record);
  writePresets(records, folder / "presets.toml");
  EXPECT_EQ(withoutFirstLine(presets()), withoutFirstLine(readFile(folder / "presets.toml")))
      << "choose them anew: see studies/README.md";
}

INSTANTIATE_TEST_SUITE_P(Effects, Front, testing::Values("ssao"),
                         [](const auto& test) { return std::string(test.param); });

// RMSE over surfaces, the truth's own noise taken out.
double errorOf(const image::Image& shown, const image::Image& truth, const image::Image& noise,
               const image::Image& depth) {
  double sum = 0, count = 0;
  for (size_t i = 0; i < truth.pixels.size(); ++i) {
    if (depth.pixels[i] == 0) continue;
    const double difference = double{shown.pixels[i]} - truth.pixels[i];
    sum += difference * difference - double{noise.pixels[i]} * noise.pixels[i];
    ++count;
  }
  return std::sqrt(sum / count);
}

// The effect may not have changed since: its errors are still the study's, on its first camera.
TEST(Study, OfSsaoIsStillTrue) {
  const TemporaryFolder folder;
  const std::string view =
      " --size 640x360 --camera " + (kSource / "studies/cameras/atrium.json").string();
  const tests::Outcome truth = tests::runShell(
      "grisaille truth --no-cache --samples 128 --write ao=t.exr --write ao_error=e.exr --write "
      "depth=d.exr" +
          view,
      folder.path());
  ASSERT_EQ(truth.status, 0) << truth.err;
  const image::Image right = image::read(folder / "t.exr"), noise = image::read(folder / "e.exr"),
                     depth = image::read(folder / "d.exr");
  std::vector<Row> rows = readStudy(kSource / "studies/ssao.csv");
  std::erase_if(rows, [](const Row& row) { return row.record.backend != "opengl"; });
  ASSERT_GT(rows.size(), 20u);
  for (size_t i = 0; i < rows.size(); i += rows.size() / 10) {
    std::string sets;
    for (const auto& [name, value] : rows[i].record.setting) sets += " --set " + name + "=" + value;
    const tests::Outcome render = tests::runShell(
        "grisaille render --backend opengl --write ao=a.exr" + view + sets, folder.path());
    ASSERT_EQ(render.status, 0) << render.err;
    const double error = errorOf(image::read(folder / "a.exr"), right, noise, depth);
    EXPECT_NEAR(error, rows[i].ofFirst, 5e-4)
        << sets << ": measure anew and choose the presets anew, see studies/README.md";
  }
}

}  // namespace
}  // namespace grisaille::app::study
