// SPDX-License-Identifier: MIT
// The build's shader compiler: the sources that it refuses, and the reflection of those that it
// accepts.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace grisaille::tests {
namespace {

namespace fs = std::filesystem;

class ShaderCompiler : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "shader_compiler_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override { fs::remove_all(folder_); }

  static int statusOf(const std::string& command) {
    const int status = std::system((command + " 2>/dev/null").c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  // Compiles GLSL of a stage: a common prefix and the given body. Returns the tool's exit status.
  int compile(const std::string& body, const std::string& stage = "comp") {
    const fs::path source = folder_ / ("shader." + stage);
    std::ofstream(source) << "#version 460\n#include \"common/bindings.glsl\"\n"
                          << (stage == "comp" ? "layout(local_size_x = 4, local_size_y = 2) in;\n"
                                              : "")
                          << body;
    const std::string spirv = (folder_ / "shader.spv").string();
    const int compiled =
        statusOf(std::string(GLSLC) + " --target-env=vulkan1.3 -g -I " SHADER_INCLUDE " '" +
                 source.string() + "' -o '" + spirv + "'");
    EXPECT_EQ(compiled, 0) << body;
    return statusOf(std::string(SHADER_COMPILER) + " '" + spirv + "' probe '" +
                    (folder_ / "probe").string() + "'");
  }
  std::string made(const char* file) {
    std::ostringstream text;
    text << std::ifstream(folder_ / file).rdbuf();
    return text.str();
  }
  bool wrote() { return fs::exists(folder_ / "probe.c") || fs::exists(folder_ / "probe.h"); }

  fs::path folder_;
};

TEST_F(ShaderCompiler, RefusesWhatTheLayerLacks) {
  const char* refused[] = {
      // binding in another class's range, or in another set
      "layout(STORAGE(0)) uniform B { uint a; } b;\nvoid main() { uint x = b.a; }\n",
      "layout(UNIFORM(0)) buffer B { uint a; } b;\nvoid main() { b.a = 1; }\n",
      "layout(IMAGE(0)) uniform sampler2D s;\nlayout(STORAGE(0)) buffer B { vec4 a; } b;\n"
      "void main() { b.a = textureLod(s, vec2(0), 0); }\n",
      "layout(TEXTURE(0), r32f) uniform image2D i;\nvoid main() { imageStore(i, ivec2(0), "
      "vec4(0)); }\n",
      "layout(set = 1, binding = 16) buffer B { uint a; } b;\nvoid main() { b.a = 1; }\n",
      "layout(STORAGE(16)) buffer B { uint a; } b;\nvoid main() { b.a = 1; }\n",
      // two resources at one binding
      "layout(STORAGE(3)) buffer A { uint a; } x;\nlayout(STORAGE(3)) buffer B { float b; } y;\n"
      "void main() { x.a = 1; y.b = 2.0; }\n",
      // resource kinds that the layer lacks
      "layout(push_constant) uniform P { uint a; } p;\nlayout(STORAGE(0)) buffer B { uint a; } b;\n"
      "void main() { b.a = p.a; }\n",
      "layout(TEXTURE(0)) uniform sampler2D s[2];\nlayout(STORAGE(0)) buffer B { vec4 a; } b;\n"
      "void main() { b.a = textureLod(s[1], vec2(0), 0); }\n",
      "layout(TEXTURE(0)) uniform texture2D t;\nlayout(TEXTURE(1)) uniform sampler s;\n"
      "layout(STORAGE(0)) buffer B { vec4 a; } b;\n"
      "void main() { b.a = textureLod(sampler2D(t, s), vec2(0), 0); }\n",
      "layout(TEXTURE(0)) uniform sampler3D s;\nlayout(STORAGE(0)) buffer B { vec4 a; } b;\n"
      "void main() { b.a = textureLod(s, vec3(0), 0); }\n",
      "layout(IMAGE(0), rgba16ui) uniform uimage2D i;\n"
      "void main() { imageStore(i, ivec2(0), uvec4(0)); }\n",
  };
  for (const char* body : refused) {
    EXPECT_EQ(compile(body), 1) << body;
    EXPECT_FALSE(wrote()) << body;
  }
}

TEST_F(ShaderCompiler, RefusesWhatIsNotSpirv) {
  const std::string file = (folder_ / "junk.spv").string();
  const std::string tail = "' probe '" + (folder_ / "probe").string() + "'";
  for (const size_t size : {0u, 4u, 20u, 21u, 400u}) {
    std::ofstream(file) << std::string(size, 'x');
    EXPECT_EQ(statusOf(std::string(SHADER_COMPILER) + " '" + file + tail), 1) << size;
  }
  EXPECT_EQ(statusOf(std::string(SHADER_COMPILER) + " '" + file + "missing" + tail), 1);
  EXPECT_EQ(statusOf(SHADER_COMPILER), 1);
  EXPECT_FALSE(wrote());
}

TEST_F(ShaderCompiler, ReflectsWhatItTakes) {
  ASSERT_EQ(compile("layout(constant_id = 7) const int kSteps = 12;\n"
                    "layout(UNIFORM(1), std140) uniform Values { vec4 a; uint count; } values;\n"
                    "layout(STORAGE(2)) readonly buffer In { uint from[]; };\n"
                    "layout(TEXTURE(3)) uniform sampler2DArray layers;\n"
                    "layout(IMAGE(4), rgba16f) writeonly uniform image2D result;\n"
                    "void main() {\n"
                    "  vec4 sum = values.a * float(from[values.count] + kSteps);\n"
                    "  imageStore(result, ivec2(0), sum + textureLod(layers, vec3(0), 0));\n"
                    "}\n"),
            0);
  const std::string source = made("probe.c");
  for (const char* row : {"{0u, 1u, 1u, 0u, 20u, 0u, \"\", ", "{1u, 2u, 1u, 0u, 0u, 0u, \"\", ",
                          "{2u, 3u, 1u, 0u, 0u, 1u, \"\", \"layers\"}",
                          "{3u, 4u, 0u, 1u, 0u, 0u, \"rgba16f\", \"result\"}",
                          "{7u, 1u, 0xcu, \"kSteps\"}", "{4u, 2u, 1u}"}) {
    EXPECT_NE(source.find(row), std::string::npos) << row << " is not in\n" << source;
  }
  EXPECT_EQ(source.find(folder_.string()), std::string::npos)
      << "the generated code contains the source's path";
  EXPECT_NE(made("probe.h").find("GRISAILLE_CHECK_BLOCK_probe_Values"), std::string::npos);
}

TEST_F(ShaderCompiler, ReflectsInputsAndOutputs) {
  ASSERT_EQ(compile("layout(location = 2) in vec2 uv;\nlayout(location = 0) in vec3 position;\n"
                    "void main() { gl_Position = vec4(position, uv.x); }\n",
                    "vert"),
            0);
  EXPECT_NE(made("probe.c").find("{0u, 2u, 3u, \"position\"},\n    {2u, 2u, 2u, \"uv\"}"),
            std::string::npos)
      << made("probe.c");
  ASSERT_EQ(compile("layout(location = 0) out vec4 color;\nlayout(location = 1) out uint id;\n"
                    "void main() { color = vec4(1); id = 3; }\n",
                    "frag"),
            0);
  EXPECT_NE(made("probe.c").find("{0u, 2u, 4u, \"color\"},\n    {1u, 0u, 1u, \"id\"}"),
            std::string::npos)
      << made("probe.c");
}

}  // namespace
}  // namespace grisaille::tests
