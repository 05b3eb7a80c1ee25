// SPDX-License-Identifier: MIT
#include "app/viewer/session_file.h"

#include <fstream>

#include "core/scene/camera.h"
#include "tests/support/expect_error.h"
#include "tests/support/folder_test.h"

namespace grisaille::app::viewer {
namespace {

namespace fs = std::filesystem;

class SessionFile : public tests::FolderTest {
 protected:
  std::string write(const std::string& name, const std::string& text) const {
    return fileOf(name, text);
  }
};

SavedSession whole() {
  SavedSession session;
  session.scene = "/models/a \"hall\".glb";
  session.pose = {.animation = 2, .seconds = 1.0 / 3};
  session.camera = scene::atriumCamera();
  session.effects.effects = {{"ssao", true, {{"estimator", "classic"}, {"radius", "0.1"}}},
                             {"other", false, {}}};
  session.held = session.effects;
  session.held->effects[0].on = false;
  session.objects["sspm"] = R"({"shots":[{"origin":[0.1,1,2]}],"version":1})";
  session.surface = "base";
  session.background = "transparent";
  session.left = "ssao.ao";
  session.right = "depth";
  session.split = session.inspecting = true;
  session.line = 0.25f;
  session.splitting = {.way = SplitWay::kFlicker, .full = 0.5f, .turn = 1, .backend = "vulkan"};
  session.fineness = {.halves = false, .converges = true};
  session.comparing = {.on = true, .output = "ssao.ao", .radius = 0.3, .rays = 64};
  session.sequence = {.keys = {scene::atriumCamera(), scene::atriumCamera()},
                      .seconds = 2.5,
                      .animated = true,
                      .file = "a.##.png",
                      .filmed = true,
                      .video = "a.webm"};
  session.sequence.keys[1].eye.y += 1.0 / 3;
  session.backend = "opengl";
  session.layout = {
      .textScale = 1.25, .light = true, .panelWidth = 30, .sections = {{"Cost", true}}};
  return session;
}

TEST_F(SessionFile, ComesBackAsItWasSaved) {
  const fs::path file = folder_ / "not yet/there/session.json";
  for (const SavedSession& session : {SavedSession(), whole()}) {
    saveSession(session, file);
    EXPECT_TRUE(isSessionFile(file));
    EXPECT_EQ(sessionJson(loadSession(file), file.parent_path()),
              sessionJson(session, file.parent_path()));
  }
  const SavedSession read = loadSession(file);
  EXPECT_EQ(read.effects, whole().effects);
  EXPECT_EQ(read.held, whole().held);
  EXPECT_EQ(read.objects, whole().objects);
  EXPECT_EQ(read.layout, whole().layout);
  EXPECT_EQ(read.fineness, whole().fineness);
  ASSERT_EQ(read.sequence.keys.size(), 2u);
  EXPECT_EQ(read.sequence.keys[1].eye, whole().sequence.keys[1].eye);
  EXPECT_EQ(read.sequence.seconds, 2.5);
  EXPECT_TRUE(read.sequence.animated && read.sequence.filmed);
  EXPECT_EQ(read.sequence.file + read.sequence.video, "a.##.pnga.webm");
  EXPECT_EQ(scene::cameraJson(*read.camera), scene::cameraJson(*whole().camera));
  EXPECT_EQ(std::distance(fs::directory_iterator(file.parent_path()), {}), 1);
}

// A session is shared as a folder: its scene is found beside it.
TEST_F(SessionFile, ASceneThatMovedWithItIsFound) {
  fs::create_directories(folder_ / "here/models");
  write("here/models/a.glb", "");
  SavedSession session;
  session.scene = (folder_ / "here/models/a.glb").string();
  saveSession(session, folder_ / "here/session.json");
  fs::rename(folder_ / "here", folder_ / "there");
  EXPECT_EQ(loadSession(folder_ / "there/session.json").scene,
            (folder_ / "there/models/a.glb").string());
}

TEST_F(SessionFile, ABrokenFileIsRefused) {
  const std::string contents[] = {"",
                                  "{",
                                  "[]",
                                  "{}",
                                  "\xff\xfe",
                                  R"({"grisaille_session": 2})",
                                  R"({"grisaille_session": 1, "scene": 3})",
                                  R"({"grisaille_session": 1, "camera": {"eye": [0, 0, 0]}})",
                                  R"({"grisaille_session": 1, "camera": []})",
                                  R"({"grisaille_session": 1, "effects": {}})",
                                  R"({"grisaille_session": 1, "effects": [1]})",
                                  R"({"grisaille_session": 1, "effects": [{"values": {"a": 1}}]})",
                                  R"({"grisaille_session": 1, "objects": []})",
                                  R"({"grisaille_session": 1, "pose": {"animation": -1}})",
                                  R"({"grisaille_session": 1, "view": {"line": 2}})",
                                  R"({"grisaille_session": 1, "view": {"line": 1e999}})",
                                  R"({"grisaille_session": 1, "view": {"compare_by": "eye"}})",
                                  R"({"grisaille_session": 1, "view": {"surface": "red"}})",
                                  R"({"grisaille_session": 1, "truth": {"rays": 1}})",
                                  R"({"grisaille_session": 1, "sequence": []})",
                                  R"({"grisaille_session": 1, "sequence": {"cameras": [1]}})",
                                  R"({"grisaille_session": 1, "sequence": {"cameras": {}}})",
                                  R"({"grisaille_session": 1, "sequence": {"seconds": 0}})",
                                  R"({"grisaille_session": 1, "sequence": {"files": 3}})",
                                  R"({"grisaille_session": 1, "panel": {"panel_width": 0}})",
                                  R"({"grisaille_session": 1, "panel": {"sections": {"a": 1}}})"};
  for (const std::string& content : contents) {
    SCOPED_TRACE(content);
    EXPECT_ERROR(ErrorId::kSessionFile, parseSession(content, folder_));
    EXPECT_ERROR(ErrorId::kSessionFile, loadSession(write("bad.json", content)));
  }
  EXPECT_ERROR(ErrorId::kSessionFile, loadSession(folder_ / "missing.json"));
  EXPECT_ERROR(ErrorId::kSessionFile, loadSession(folder_));
  EXPECT_ERROR(ErrorId::kFileUnwritable, saveSession({}, "/proc/no/session.json"));
  EXPECT_FALSE(isSessionFile(folder_ / "missing.json"));
  EXPECT_FALSE(isSessionFile(write("camera.json", R"({"eye": [0, 0, 1]})")));
}

}  // namespace
}  // namespace grisaille::app::viewer
