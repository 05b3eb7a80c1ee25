// SPDX-License-Identifier: MIT
// Files that are opened or dropped, valid or not: no work is lost.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/viewer/session.h"
#include "core/image/image.h"
#include "core/objects/object_file.h"
#include "tests/program/run.h"
#include "tests/support/expect_error.h"

namespace grisaille::app::viewer {
namespace {

class SessionTest : public testing::Test {
 protected:
  static SessionOptions options() {
    SessionOptions options;
    options.effects = {"ssao", "sspm"};
    options.effectsGiven = true;
    options.pluginPaths = {EFFECTS_FOLDER};
    return options;
  }
  size_t shots() { return session_.listOf("sspm").size(); }

  tests::TemporaryFolder folder_;
  Session session_{options()};
};

constexpr const char* kShots =
    R"({"version": 1, "shots": [{"origin": [0, 1, 2], "direction": [0, 0, -1], "color": [1, 0, 0]}]})";

TEST_F(SessionTest, OpensWhatAFileHolds) {
  session_.openFile(
      folder_.write("a.toml", "effects = [\"ssao\", \"sspm\"]\n[ssao]\nradius = 2\n"));
  EXPECT_EQ(session_.chain.selection.find("ssao")->values.get("radius"), 2);
  session_.openFile(folder_.write("b.json", kShots));
  EXPECT_EQ(shots(), 1u);
  session_.openFile(
      folder_.write("c.json", R"({"eye": [1, 2, 3], "target": [0, 0, 0], "fovy_degrees": 60})"));
  EXPECT_EQ(session_.camera.eye, glm::dvec3(1, 2, 3));
  objects::Objects three(session_.listOf("sspm").table());
  for (int i = 0; i < 3; ++i) three.append(session_.listOf("sspm").object(0));
  objects::save(three.view(), folder_ / "d.json");
  session_.openFile(folder_ / "d.json");
  EXPECT_EQ(shots(), 3u);
  // One undo step covers the whole file.
  session_.undo();
  EXPECT_EQ(shots(), 1u);
  session_.undo();
  EXPECT_EQ(shots(), 0u);
  session_.undo();
  EXPECT_EQ(session_.chain.selection.find("ssao")->values.get("radius"), 0.5);
  session_.redo();
  session_.redo();
  session_.redo();
  EXPECT_EQ(shots(), 3u);
  EXPECT_EQ(session_.chain.selection.find("ssao")->values.get("radius"), 2);
}

TEST_F(SessionTest, ABuiltInSceneIsANameInCommands) {
  const auto carving = std::make_shared<scene::Scene>(scene::loadScene("carving"));
  session_.setScene(carving, "carving", {64, 64});
  const std::string command = session_.commandLine({64, 64}, "", "");
  EXPECT_TRUE(command.starts_with("grisaille render carving --camera ")) << command;
}

TEST_F(SessionTest, TakesACameraAsText) {
  SessionOptions text = options();
  text.camera = R"({"eye": [1, 2, 3], "target": [0, 0, 0], "fovy_degrees": 60})";
  EXPECT_EQ(Session(text).camera.eye, glm::dvec3(1, 2, 3));
  text.camera = "{}";
  EXPECT_ERROR(ErrorId::kCameraInvalid, Session{text});
}

TEST_F(SessionTest, WhatIsBrokenChangesNothing) {
  session_.openFile(folder_.write("b.json", kShots));
  const effect::Selection::State before = session_.chain.selection.state();
  const auto refused = [&](const std::string& name, const std::string& text, ErrorId id) {
    const std::string file = folder_.write(name, text);
    SCOPED_TRACE(name);
    EXPECT_ERROR(id, session_.openFile(file));
    EXPECT_EQ(shots(), 1u);
    EXPECT_EQ(session_.chain.selection.state(), before);
  };
  refused("a.toml", "effects = [", ErrorId::kSettingsUnreadable);
  refused("a.toml", "[ssao]\nradius = -1\n", ErrorId::kParameterRange);
  refused("a.toml", "effects = [\"none\"]\n", ErrorId::kEffectUnknown);
  refused("b2.json", R"({"version": 1, "shots": [{}]})", ErrorId::kObjectFileInvalid);
  refused("c.json", R"({"eye": [0, 0, 0], "target": [0, 0, 0]})", ErrorId::kCameraInvalid);
  refused("d.txt", "text", ErrorId::kFileUnknown);
  EXPECT_ERROR(ErrorId::kSettingsUnreadable, session_.openFile(folder_ / "missing.toml"));
}

TEST_F(SessionTest, AnErrorGoesOnceTheSameThingSucceeds) {
  session_.setScene(std::make_shared<scene::Scene>(scene::loadScene("carving")), "carving",
                    {64, 64});
  const auto errors = [&] { return std::ranges::count(session_.messages, true, &Message::error); };
  const auto fail = [] { throw Error(ErrorId::kUsage, "no"); };
  EXPECT_FALSE(session_.attempt("one", fail));
  EXPECT_FALSE(session_.attempt("another", fail));
  EXPECT_FALSE(session_.attempt("one", fail));
  EXPECT_EQ(errors(), 2);
  EXPECT_TRUE(session_.attempt("one", [] {}));
  EXPECT_EQ(errors(), 1);
  EXPECT_EQ(session_.messages.back().about, "another");
  EXPECT_TRUE(session_.attempt("another", [] {}));
  EXPECT_EQ(errors(), 0);
  // A picture that an effect reads.
  grisaille_picture picture{};
  picture.struct_size = sizeof(picture);
  const std::string file = folder_ / "moss.png";
  const auto read = [&] { session_.services->all().pictures->read(file.c_str(), picture); };
  EXPECT_ERROR(ErrorId::kImageUnreadable, read());
  EXPECT_EQ(errors(), 1);
  image::write({.width = 1, .height = 1, .channels = 3, .pixels = {0, 0, 0}}, file);
  read();
  EXPECT_EQ(errors(), 0);
}

TEST_F(SessionTest, HeldSettingsStayWhatTheyWere) {
  session_.hold();
  session_.chain.selection.find("ssao")->values.set("radius", 3.0);
  session_.changed("ssao.radius");
  session_.noteChanges();
  EXPECT_EQ(session_.held->find("ssao")->values.get("radius"), 0.5);
  session_.swapHeld();
  EXPECT_EQ(session_.held->find("ssao")->values.get("radius"), 3);
  EXPECT_EQ(session_.chain.selection.find("ssao")->values.get("radius"), 0.5);
}

TEST_F(SessionTest, ComparesTheFirstVisibilityWithItsOwnRadius) {
  session_.left = "depth";
  session_.compareWithTruth(true);
  EXPECT_EQ(session_.comparedOutput(), "ssao.ao");
  EXPECT_EQ(session_.left, kErrorView);
  session_.chain.selection.find("ssao")->values.set("radius", 3.0);
  EXPECT_EQ(session_.truthRadius(), 3);
  session_.setTruthRadius(2);
  EXPECT_EQ(session_.truthRadius(), 2);
  for (const double radius : {0.0, -1.0, 1e9, std::nan("")}) {
    EXPECT_ERROR(ErrorId::kUsage, session_.setTruthRadius(radius));
  }
  EXPECT_EQ(session_.truthRadius(), 2);
  // The command writes the compared output: frames have no error output.
  EXPECT_NE(session_.commandLine({64, 36}, "", "").find("ssao.ao=grisaille.png"),
            std::string::npos);
  session_.compareWithTruth(false);
  EXPECT_EQ(session_.left, "depth");
  EXPECT_EQ(session_.comparedOutput(), "");

  session_.compareWithTruth(true);
  session_.chain.selection.find("ssao")->on = false;
  session_.checkViews();
  EXPECT_EQ(session_.comparedOutput(), "");
  EXPECT_EQ(session_.left, "color");
  session_.compareWithTruth(false);
  session_.compareWithTruth(true);
  EXPECT_FALSE(session_.comparing.on);
  EXPECT_NE(session_.messages.back().text.find("visibility"), std::string::npos);
}

}  // namespace
}  // namespace grisaille::app::viewer
