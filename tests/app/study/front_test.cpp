// SPDX-License-Identifier: MIT
// The presets in the tree follow from the study in the tree, and the study is still up to date.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <set>
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
  double ofFirst = 0;  // RMSE with the first camera
};

// The errors of a camera from a column "rmse of SCENE/CAMERA" or "rmse of CAMERA".
CameraErrors errorsOf(const std::string& column, const std::string& value) {
  const std::string place = column.substr(std::string("rmse of ").size());
  const size_t slash = place.find('/');
  CameraErrors errors = {.scene = {}, .camera = place, .rmse = std::stod(value)};
  if (slash != std::string::npos) {
    errors.scene = place.substr(0, slash);
    errors.camera = place.substr(slash + 1);
  }
  return errors;
}

// Reads the results.csv of a study.
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
        row.record.setting.push_back({effect::parseParameterName(names[i]), values[i]});
      }
      if (names[i].starts_with("rmse of ")) {
        row.record.errors.push_back(errorsOf(names[i], values[i]));
      }
    }
    row.record.study = "size 1x1\n";
    row.record.backend = all.at("backend");
    row.record.milliseconds = {
        std::vector<double>(row.record.errors.size(), std::stod(all.at("milliseconds")))};
    row.ofFirst = row.record.errors.front().rmse;
    EXPECT_NEAR(row.record.rmse(), std::stod(all.at("rmse")), 1e-9);
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
  std::vector<NamedPreset> more;
  if (GetParam() == std::string("ssao")) {
    more.push_back(parseNamedPreset("classic=ssao.estimator=classic"));
  }
  writePresets(records, more, folder / "presets.toml");
  EXPECT_EQ(withoutFirstLine(presets()), withoutFirstLine(readFile(folder / "presets.toml")))
      << "choose the presets again, see studies/README.md";
}

INSTANTIATE_TEST_SUITE_P(Effects, Front, testing::Values("ssao", "sspm"),
                         [](const auto& test) { return std::string(test.param); });

// RMSE of the last channel over surfaces, without the truth's own noise. `noise`: null if it has
// none.
double errorOf(const image::Image& shown, const image::Image& truth, const image::Image* noise,
               const image::Image& depth) {
  double sum = 0, count = 0;
  for (size_t i = 0; i < truth.pixels.size(); ++i) {
    if (depth.pixels[i] == 0) continue;
    const double difference = double{shown.pixels[(i + 1) * shown.channels - 1]} - truth.pixels[i];
    const double spread = noise == nullptr ? 0 : noise->pixels[i];
    sum += difference * difference - spread * spread;
    ++count;
  }
  return std::sqrt(sum / count);
}

// Renders some settings of a study with its first camera and expects the study's errors.
class Study : public testing::Test {
 protected:
  image::Image truth(const std::string& name, const std::string& more) {
    const tests::Outcome outcome = tests::runShell(
        "grisaille truth --no-cache --write " + name + "=t.exr --write depth=d.exr" + more + view_,
        folder_.path());
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return image::read(folder_ / "t.exr");
  }

  void expectErrors(const std::string& effect, const std::string& output, size_t count,
                    const std::string& more, const image::Image& right, const image::Image* noise) {
    const image::Image depth = image::read(folder_ / "d.exr");
    std::vector<Row> rows = readStudy(kSource / "studies" / (effect + ".csv"));
    // Settings that differ only in a parameter without effect appear several times.
    std::set<double> known;
    std::erase_if(rows, [&](const Row& row) {
      return row.record.backend != "opengl" || !known.insert(row.ofFirst).second;
    });
    ASSERT_GE(rows.size(), count);
    for (size_t i = 0; i < rows.size(); i += rows.size() / count) {
      std::string sets;
      for (const effect::Assignment& one : rows[i].record.setting) sets += " --set " + one.text();
      const tests::Outcome render = tests::runShell(
          "grisaille render --backend opengl --write " + output + "=a.exr" + view_ + more + sets,
          folder_.path());
      ASSERT_EQ(render.status, 0) << render.err;
      const double error = errorOf(image::read(folder_ / "a.exr"), right, noise, depth);
      EXPECT_NEAR(error, rows[i].ofFirst, 5e-4)
          << sets << ": measure and choose the presets again, see studies/README.md";
    }
  }

  const TemporaryFolder folder_;
  std::string view_ =
      " --camera " + (kSource / "studies/cameras/atrium.json").string() + " --size ";
};

// Fails if the effect has changed since the study.
TEST_F(Study, OfSsaoIsStillTrue) {
  view_ += "1280x720";
  const image::Image right = truth("ao", " --samples 128 --write ao_error=e.exr");
  const image::Image noise = image::read(folder_ / "e.exr");
  expectErrors("ssao", "ao", 10, "", right, &noise);
}

TEST_F(Study, OfSspmIsStillTrue) {
  view_ += "640x360";
  const std::string shots = (kSource / "studies/shots/atrium.json").string();
  truth("ao", " --samples 16");  // writes the depth
  const tests::Outcome mask = tests::runShell(
      "grisaille-lab paint-mask --load " + shots + " --write m.exr" + view_, folder_.path());
  ASSERT_EQ(mask.status, 0) << mask.err;
  const image::Image right = image::read(folder_ / "m.exr");
  expectErrors("sspm", "paint", 2, " --effects sspm --set sspm.edge_fade=0 --load sspm=" + shots,
               right, nullptr);
}

}  // namespace
}  // namespace grisaille::app::study
