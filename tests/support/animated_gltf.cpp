// SPDX-License-Identifier: MIT
#include "tests/support/animated_gltf.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

namespace grisaille::tests {
namespace {

using nlohmann::json;
using Floats = std::vector<float>;

constexpr int kFloat = 5126, kShort = 5123, kByte = 5121;

class Writer {
 public:
  json document = json::parse(R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{}],
                                  "buffers": [{}]})");
  float slowness = 1;  // factor for the times of all keys

  template <typename T>
  size_t accessor(const std::vector<T>& values, const char* type, size_t components) {
    const int code = sizeof(T) == 4 ? kFloat : sizeof(T) == 2 ? kShort : kByte;
    const size_t bytes = values.size() * sizeof(T);
    json& views = document["bufferViews"];
    views.push_back({{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes}});
    binary_.append(reinterpret_cast<const char*>(values.data()), bytes);
    binary_.resize((binary_.size() + 3) / 4 * 4, '\0');
    json entry = {{"bufferView", views.size() - 1},
                  {"componentType", code},
                  {"count", values.size() / components},
                  {"type", type}};
    document["accessors"].push_back(entry);
    return document["accessors"].size() - 1;
  }

  // Adds a mesh of positions (three numbers each) with four corners for each face.
  json& quads(const Floats& positions) {
    std::vector<uint16_t> indices;
    for (size_t first = 0; first < positions.size() / 3; first += 4) {
      for (const size_t k : {0, 1, 2, 0, 2, 3}) indices.push_back(uint16_t(first + k));
    }
    const size_t place = accessor(positions, "VEC3", 3);
    // The specification demands the bounds of positions.
    json low = json::array(), high = json::array();
    for (size_t c = 0; c < 3; ++c) {
      float least = positions[c], most = least;
      for (size_t i = c; i < positions.size(); i += 3) {
        least = std::min(least, positions[i]);
        most = std::max(most, positions[i]);
      }
      low.push_back(least), high.push_back(most);
    }
    document["accessors"][place]["min"] = low;
    document["accessors"][place]["max"] = high;
    const json primitive = {{"attributes", {{"POSITION", place}}},
                            {"indices", accessor(indices, "SCALAR", 1)}};
    document["meshes"].push_back({{"primitives", json::array({primitive})}});
    return document["meshes"].back()["primitives"][0];
  }

  void animate(size_t animation, size_t node, const char* path, Floats seconds,
               const Floats& values, const char* interpolation) {
    for (float& second : seconds) second *= slowness;
    const std::string what = path;
    const char* type = what == "rotation" ? "VEC4" : what == "weights" ? "SCALAR" : "VEC3";
    const size_t width = what == "rotation" ? 4 : what == "weights" ? 1 : 3;
    json& to = document["animations"][animation];
    const size_t keys = accessor(seconds, "SCALAR", 1);
    document["accessors"][keys]["min"] = {seconds.front()};
    document["accessors"][keys]["max"] = {seconds.back()};
    to["samplers"].push_back({{"input", keys},
                              {"output", accessor(values, type, width)},
                              {"interpolation", interpolation}});
    to["channels"].push_back(
        {{"sampler", to["samplers"].size() - 1}, {"target", {{"node", node}, {"path", path}}}});
  }

  std::string glb() {
    document["buffers"][0]["byteLength"] = binary_.size();
    const auto word = [](size_t value) {
      const auto narrow = static_cast<uint32_t>(value);
      return std::string(reinterpret_cast<const char*>(&narrow), 4);
    };
    std::string text = document.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::string chunks = word(text.size()) + "JSON" + text + word(binary_.size()) +
                               std::string("BIN\0", 4) + binary_;
    return "glTF" + word(2) + word(12 + chunks.size()) + chunks;
  }

 private:
  std::string binary_;
};

// The six faces of a box on the plane y = 0.
Floats box(float half, float height) {
  Floats all;
  const auto face = [&](std::array<std::array<float, 3>, 4> corners) {
    for (const auto& p : corners) {
      all.insert(all.end(), {half * p[0], height * p[1], half * p[2]});
    }
  };
  face({{{-1, 0, 1}, {1, 0, 1}, {1, 1, 1}, {-1, 1, 1}}});
  face({{{1, 0, -1}, {-1, 0, -1}, {-1, 1, -1}, {1, 1, -1}}});
  face({{{1, 0, 1}, {1, 0, -1}, {1, 1, -1}, {1, 1, 1}}});
  face({{{-1, 0, -1}, {-1, 0, 1}, {-1, 1, 1}, {-1, 1, -1}}});
  face({{{-1, 1, 1}, {1, 1, 1}, {1, 1, -1}, {-1, 1, -1}}});
  face({{{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}}});
  return all;
}

// A closed column of `rings` boxes, one on the other.
Floats column(float half, float height, int rings) {
  Floats all;
  for (int i = 0; i < rings; ++i) {
    Floats one = box(half, height / static_cast<float>(rings));
    const float up = height * static_cast<float>(i) / static_cast<float>(rings);
    for (size_t k = 1; k < one.size(); k += 3) one[k] += up;
    const size_t sides = one.size() / 6 * 4, face = one.size() / 6;
    all.insert(all.end(), one.begin(), one.begin() + static_cast<ptrdiff_t>(sides));
    if (i + 1 == rings) {
      all.insert(all.end(), one.begin() + static_cast<ptrdiff_t>(sides),
                 one.begin() + static_cast<ptrdiff_t>(sides + face));
    }
  }
  return all;
}

// Two joints: the lower end follows the first, the upper end the second.
void addSkin(Writer& writer, json& arm, const Floats& positions, float height) {
  std::vector<uint8_t> joints;
  Floats weights;
  for (size_t i = 1; i < positions.size(); i += 3) {
    const float upper = positions[i] / height;
    joints.insert(joints.end(), {0, 1, 0, 0});
    weights.insert(weights.end(), {1 - upper, upper, 0, 0});
  }
  arm["attributes"]["JOINTS_0"] = writer.accessor(joints, "VEC4", 4);
  arm["attributes"]["WEIGHTS_0"] = writer.accessor(weights, "VEC4", 4);
  Floats binds(32, 0.0f);
  for (const size_t i : {0, 5, 10, 15, 16, 21, 26, 31}) binds[i] = 1;
  binds[29] = -height / 2;
  writer.document["skins"] = {
      {{"joints", {3, 4}}, {"inverseBindMatrices", writer.accessor(binds, "MAT4", 16)}}};
}

void addAnimations(Writer& writer) {
  const auto turn = [](float degrees) {
    const float half = degrees / 2 * 3.14159265f / 180;
    return Floats{0, 0, std::sin(half), std::cos(half)};
  };
  const auto join = [](std::initializer_list<Floats> parts) {
    Floats all;
    for (const Floats& part : parts) all.insert(all.end(), part.begin(), part.end());
    return all;
  };
  writer.document["animations"] =
      json::parse(R"([{"name": "move"}, {"name": "jump"}, {}, {"name": "high"}])");
  const Floats zero = {0, 0, 0};
  // In-tangent, value, out-tangent.
  writer.animate(0, 1, "translation", {0, 1, 2},
                 join({zero,
                       {-1.5f, 0, 1},
                       {0, 2, 0},
                       zero,
                       {-1.5f, 1, 1.5f},
                       {1, 0, 0},
                       {0, -2, 0},
                       {-0.5f, 0, 1},
                       zero}),
                 "CUBICSPLINE");
  writer.animate(0, 1, "rotation", {0, 2}, join({turn(0), turn(80)}), "LINEAR");
  writer.animate(0, 4, "rotation", {0, 1, 2}, join({turn(0), turn(60), turn(-50)}), "LINEAR");
  writer.animate(0, 5, "weights", {0, 2}, {0, 0, 1, 1, 1, 0}, "CUBICSPLINE");
  writer.animate(1, 1, "translation", {0, 0.5f, 1}, {-1.5f, 0, 1, -1, 0.5f, 1.5f, -0.5f, 0, 1},
                 "STEP");
  writer.animate(1, 4, "rotation", {0, 0.5f, 1}, join({turn(0), turn(45), turn(-45)}), "STEP");
  writer.animate(1, 5, "weights", {0, 0.5f}, {0, 1}, "STEP");
  writer.animate(2, 1, "scale", {0, 0.5f}, {1, 1, 1, 1, 2, 1}, "LINEAR");
  writer.animate(3, 1, "translation", {0, 1}, {-1.5f, 0, 1, -1.5f, 12, 1}, "LINEAR");
}

}  // namespace

std::string animatedGlb(float slowness) {
  Writer writer;
  writer.slowness = slowness;
  writer.document["scenes"][0]["nodes"] = {0, 1, 2, 3, 5};
  writer.document["nodes"] = json::parse(R"([
      {"name": "floor", "mesh": 0},
      {"name": "box", "mesh": 1, "translation": [-1, 0, 1]},
      {"name": "arm", "mesh": 2, "skin": 0},
      {"name": "shoulder", "children": [4]},
      {"name": "elbow", "translation": [0, 1, 0]},
      {"name": "breathing", "mesh": 3, "translation": [1.5, 0, -0.5]}])");
  writer.quads({-3, 0, 3, 3, 0, 3, 3, 0, -3, -3, 0, -3});
  writer.quads(box(0.4f, 0.8f));
  constexpr float kHeight = 2;
  const Floats arm = column(0.25f, kHeight, 6);
  addSkin(writer, writer.quads(arm), arm, kHeight);
  const Floats before = box(0.4f, 0.8f), wide = box(0.7f, 1.4f);
  Floats moved;
  for (size_t i = 0; i < before.size(); ++i) moved.push_back(wide[i] - before[i]);
  const size_t target = writer.accessor(moved, "VEC3", 3);
  writer.quads(before)["targets"] = json::array({{{"POSITION", target}}});
  addAnimations(writer);
  return writer.glb();
}

}  // namespace grisaille::tests
