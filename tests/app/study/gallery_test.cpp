// SPDX-License-Identifier: MIT
// A gallery is read as it is written, and measured as its scenes are measured one by one.
#include "app/study/gallery.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "app/study/record.h"
#include "tests/program/run.h"
#include "tests/support/expect_error.h"

namespace grisaille::app::study {
namespace {

namespace fs = std::filesystem;
using tests::Outcome;
using tests::TemporaryFolder;

const std::string kStudies = fs::path(SOURCE_FOLDER) / "studies";
constexpr const char* kOne = "[[scene]]\nname = \"one\"\ncameras = [\"a.json\"]\n";

TEST(GalleryTest, HoldsTheScenesThatAreThere) {
  const TemporaryFolder folder;
  fs::create_directories(folder.path() / "scenes");
  folder.write("scenes/far.glb", "");
  folder.write("near.glb", "");
  const std::string file = folder.write(
      "g.toml", std::string(kOne) +
                    "[[scene]]\nname = \"none\"\nfile = \"none.glb\"\noptional = true\n"
                    "cameras = [\"b.json\"]\n"
                    "[[scene]]\nname = \"near\"\nfile = \"near.glb\"\nradius = 0.25\n"
                    "set = [\"ssao.radius=0.25\"]\ncameras = [\"c.json\", \"d.json\"]\n"
                    "[[scene]]\nname = \"far\"\nfile = \"far.glb\"\ncameras = [\"e.json\"]\n"
                    "[[scene]]\nname = \"built-in\"\nfile = \"leaves\"\ncameras = [\"f.json\"]\n");
  const std::vector<GalleryScene> gallery = loadGallery(file, folder / "scenes");
  ASSERT_EQ(gallery.size(), 4u);
  EXPECT_EQ(gallery[0].scene, "");
  EXPECT_EQ(gallery[0].cameras, std::vector<std::string>{folder / "a.json"});
  EXPECT_EQ(gallery[1].scene, folder / "near.glb");
  EXPECT_EQ(gallery[1].radius, 0.25);
  EXPECT_EQ(gallery[1].sets, std::vector<std::string>{"ssao.radius=0.25"});
  EXPECT_EQ(gallery[1].cameras.size(), 2u);
  EXPECT_EQ(gallery[2].scene, folder / "scenes/far.glb");
  EXPECT_EQ(gallery[3].scene, "leaves");
}

TEST(GalleryTest, AMistakeIsNamedWithItsLine) {
  const TemporaryFolder folder;
  const std::string one = kOne;
  for (const std::string& text :
       {std::string(), one + one, one + "radius = 0\n", one + "optional = 1\n",
        one + "colour = 1\n", std::string("[[scene]]\nname = \"one\"\n"),
        std::string("[[scene]]\ncameras = [\"a\"]\n"), one + "file = \"none.glb\"\n",
        one + "set = 1\n", one + "[[scene]]\nname = \"two\"\ncameras = [\"x/a.json\"]\n",
        std::string("[[scene]]\nname = \"one\"\nfile = \"none.glb\"\noptional = true\n"
                    "cameras = [\"a.json\"]\n")}) {
    const std::string file = folder.write("g.toml", text);
    SCOPED_TRACE(text);
    EXPECT_ERROR(ErrorId::kSettingsInvalid, loadGallery(file, ""));
  }
  EXPECT_ERROR(ErrorId::kSettingsUnreadable, loadGallery(folder / "none.toml", ""));
}

// The gallery of this repository can be read, with each camera, wherever its scenes are.
TEST(GalleryTest, OursHasAllItsCameras) {
  for (const GalleryScene& scene : loadGallery(kStudies + "/gallery.toml", "")) {
    for (const std::string& camera : scene.cameras) EXPECT_TRUE(fs::exists(camera)) << camera;
  }
}

TEST(GalleryTest, MeasuresEachSceneAsByItself) {
  const TemporaryFolder folder;
  const std::string corner = kStudies + "/scenes/corner.gltf";
  folder.write("corner.json",
               R"({"eye": [1.5, 1.2, 2], "target": [0, 0.3, 0], "fovy_degrees": 60})");
  folder.write("g.toml", fmt::format("[[scene]]\nname = \"atrium\"\ncameras = [\"{}\"]\n"
                                     "[[scene]]\nname = \"corner\"\nfile = \"{}\"\nradius = 0.2\n"
                                     "set = [\"ssao.radius=0.2\"]\ncameras = [\"corner.json\"]\n",
                                     kStudies + "/cameras/vases.json", corner));
  const std::string same =
      " --sweep ssao.kernel_size=4,16 --size 96x54 --samples 32 --rounds 2 --backend opengl";
  const auto measured = [&](const std::string& more) {
    const Outcome outcome = tests::runShell(
        "XDG_CACHE_HOME=cache grisaille measure --out " + more + same, folder.path());
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return loadAll(folder.path() / more.substr(0, more.find(' ')));
  };
  const auto all = measured("all --gallery g.toml");
  const auto atrium = measured("atrium --radius 0.5 --camera " + kStudies + "/cameras/vases.json");
  const auto alone =
      measured("corner " + corner + " --radius 0.2 --set ssao.radius=0.2 --camera corner.json");
  ASSERT_EQ(all.size(), 2u);
  for (const Record& record : all) {
    ASSERT_EQ(record.errors.size(), 2u);
    EXPECT_EQ(record.errors[0].scene, "atrium");
    EXPECT_EQ(record.errors[1].camera, "corner");
    ASSERT_EQ(record.milliseconds.size(), 2u);
    EXPECT_GT(record.costOf(1), 0);
    for (const auto& [part, at] : {std::pair(atrium, size_t{0}), {alone, size_t{1}}}) {
      const auto own = std::ranges::find(part, record.setting, &Record::setting);
      ASSERT_NE(own, part.end());
      EXPECT_DOUBLE_EQ(own->errors[0].rmse, record.errors[at].rmse);
    }
  }
  const std::string table = tests::readFile(folder / "all/results.csv");
  EXPECT_NE(table.find(",rmse of atrium/vases,rmse of corner/corner,milliseconds of atrium/vases,"),
            std::string::npos)
      << table;
  EXPECT_NE(
      tests::runShell("grisaille measure --gallery g.toml --camera corner.json --out x" + same,
                      folder.path())
          .status,
      0);
}

}  // namespace
}  // namespace grisaille::app::study
