// SPDX-License-Identifier: MIT
// Bad input of every kind gives one line with the fault, the reason and a remedy, and a non-zero
// exit status. It never causes a crash, a hang or a half-written file.
#include <gtest/gtest.h>

#include <sys/stat.h>

#include <algorithm>

#include "tests/program/run.h"

namespace grisaille::tests {
namespace {

struct Case {
  std::string name;
  std::string file;  // written beside the command; "" for none
  std::string content;
  std::vector<std::string> arguments;  // FILE stands for the file's path
  int number = 0;
};

constexpr const char* kCamera = R"({"eye": [0, 1, 3], "target": [0, 0, 0], "fovy_degrees": 60})";

std::string camera(const std::string& field, const std::string& value) {
  const std::string fields[][2] = {
      {"eye", "[0, 1, 3]"}, {"target", "[0, 0, 0]"}, {"fovy_degrees", "60"}};
  std::string text = "{";
  for (const auto& [name, usual] : fields) {
    text += "\"" + name + "\": " + (name == field ? value : usual) + ", ";
  }
  const bool known = std::any_of(std::begin(fields), std::end(fields),
                                 [&](const auto& one) { return one[0] == field; });
  if (!known) text += "\"" + field + "\": " + value + ", ";
  return text.substr(0, text.size() - 2) + "}";
}

Case badCamera(const std::string& name, const std::string& content, int number = 2202) {
  return {name, "camera.json", content, {"--camera", "FILE"}, number};
}
Case badScene(const std::string& name, const std::string& content, int number = 2101) {
  return {name, "scene.gltf", content, {"FILE"}, number};
}

std::vector<Case> cases() {
  const std::string asset = R"({"asset": {"version": "2.0"})";
  const std::string triangle =
      asset +
      R"(, "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,)"
      R"(AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],)"
      R"("bufferViews": [{"buffer": 0, "byteLength": 36}],)"
      R"("accessors": [{"bufferView": 0, "componentType": 5126, "count": COUNT, "type": "VEC3"}],)"
      R"("meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],)"
      R"("nodes": [{"mesh": 0NODE}], "scenes": [{"nodes": [0]}], "scene": 0})";
  const auto mesh = [&](const std::string& count, const std::string& node) {
    std::string text = triangle;
    text.replace(text.find("COUNT"), 5, count);
    text.replace(text.find("NODE"), 4, node);
    return text;
  };
  return {
      {"missing scene", "", "", {"no such scene.glb"}, 2101},
      {"folder as scene", "", "", {"."}, 2101},
      badScene("empty scene", ""),
      badScene("random bytes", "\x01\x02\x03glTF\xff\xfe"),
      badScene("JSON that is no glTF", "{\"a\": 1}"),
      badScene("truncated JSON", asset.substr(0, 12)),
      {"truncated glb", "scene.glb", std::string("glTF\x02\0\0\0\xff\0\0\0", 12), {"FILE"}, 2101},
      badScene("no triangles", asset + "}", 2104),
      badScene("unsupported extension",
               asset + R"(, "extensionsRequired": ["KHR_texture_basisu"]})", 2103),
      badScene("accessor over its buffer", mesh("4", ""), 2102),
      badScene("accessor over every limit", mesh("4000000000", ""), 2105),
      badScene("node that is its own child", mesh("3", R"(, "children": [0])"), 2102),
      badCamera("camera that is no JSON", "eye = 0", 2201),
      badCamera("camera of another kind", "[1, 2]"),
      badCamera("NaN in a camera", camera("eye", "[NaN, 0, 0]"), 2201),
      badCamera("infinite camera", camera("eye", "[1e999, 0, 0]"), 2201),
      badCamera("eye is target", camera("target", "[0, 1, 3]")),
      badCamera("two coordinates", camera("eye", "[0, 1]")),
      badCamera("text for a number", camera("fovy_degrees", "\"wide\"")),
      badCamera("field of view of 0", camera("fovy_degrees", "0")),
      badCamera("field of view of 180", camera("fovy_degrees", "180")),
      badCamera("up along the view", camera("up", "[0, 1, 3]")),
      badCamera("size of 0", camera("size", "[0, 720]")),
      badCamera("unknown key", camera("fov", "60")),
      {"missing camera", "", "", {"--camera", "no such camera.json"}, 2201},
      {"camera text that is no JSON", "", "", {"--camera", "{eye"}, 2201},
      {"camera text without an eye", "", "", {"--camera", "{}"}, 2202},
      {"surface that is none", "s.toml", "surface = \"black\"", {"--config", "FILE"}, 5104},
      {"folder to write to is missing", "", "", {"--write", "color=no/such/folder/c.png"}, 4103},
      {"name to write is a folder", "folder.png/x", "", {"--write", "color=folder.png"}, 4103},
      {"timings to a missing folder",
       "",
       "",
       {"--timings", "no/such/t.csv", "--write", "color=c.png"},
       4103},
  };
}

TEST(BadInput, EachKindIsOneLineAndANumber) {
  for (Case& bad : cases()) {
    SCOPED_TRACE(bad.name);
    const TemporaryFolder input, work;
    for (std::string& argument : bad.arguments) {
      if (argument == "FILE") argument = input / bad.file;
    }
    if (bad.file == "folder.png/x") {
      ASSERT_EQ(mkdir((work / "folder.png").c_str(), 0700), 0);
    } else if (!bad.file.empty()) {
      input.write(bad.file, bad.content);
    }
    std::vector<std::string> arguments = {"render", "--size", "16x9"};
    arguments.insert(arguments.end(), bad.arguments.begin(), bad.arguments.end());
    const Outcome outcome = runProgram(arguments, work.path());
    EXPECT_EQ(outcome.status, 1) << outcome.err;
    EXPECT_EQ(outcome.err.rfind("error E" + std::to_string(bad.number) + ": ", 0), 0u)
        << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    for (const std::string& file : work.files()) {
      EXPECT_EQ(file.find(".part"), std::string::npos) << file;
    }
  }
}

// A broken image in a scene: only commands that need the texture report it, once, and go on.
TEST(BadInput, BrokenTextureIsNotedOnlyWhereItIsNeeded) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("scene.gltf",
                                         R"({"asset": {"version": "2.0"},
        "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "images": [{"uri": "broken.png"}], "textures": [{"source": 0}],
        "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
        "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}]})");
  folder.write("broken.png", "this is not a picture");
  const std::vector<std::string> common = {"render", scene, "--size", "16x9", "--write"};
  auto ao = common, base = common;
  ao.emplace_back("ao=a.exr");
  base.emplace_back("base_colour=b.png");
  // Otherwise the program notes the radius that it chose.
  for (auto* one : {&ao, &base}) one->insert(one->end(), {"--set", "ssao.radius=0.5"});
  EXPECT_EQ(runProgram(ao, folder.path()).status, 0);
  EXPECT_EQ(runProgram(ao, folder.path()).err.find("note: "), std::string::npos);
  const Outcome outcome = runProgram(base, folder.path());
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const std::string note = "note: image \"broken.png\": ";
  EXPECT_NE(outcome.err.find(note), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find(note), outcome.err.rfind(note)) << outcome.err;
}

TEST(BadInput, FailedWriteLeavesTheOldFile) {
  const TemporaryFolder folder;
  const std::string old = folder.write("c.png", "precious");
  const Outcome outcome =
      runProgram({"render", "--camera", folder.write("camera.json", kCamera), "--effects", "ssao",
                  "--set", "ssao.radius=-1", "--write", "color=c.png"},
                 folder.path());
  EXPECT_EQ(outcome.status, 1);
  EXPECT_EQ(readFile(old), "precious");
}

}  // namespace
}  // namespace grisaille::tests
