// SPDX-License-Identifier: MIT
#include "tests/core/scene/reference_pose.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace grisaille::scene {
namespace {

using nlohmann::json;

std::string contentOf(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string decoded(const std::string& base64) {
  std::string bytes;
  uint32_t group = 0;
  int bits = 0;
  for (const char c : base64) {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const size_t digit = digits.find(c);
    if (digit == std::string::npos) break;
    group = group << 6 | static_cast<uint32_t>(digit);
    bits += 6;
    if (bits >= 8) {
      bits -= 8;
      bytes.push_back(static_cast<char>(group >> bits & 0xff));
    }
  }
  return bytes;
}

template <typename T>
double number(const char* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return static_cast<double>(value);
}

// One component, by the table of 3.11.
double component(const char* at, int type, bool normalized) {
  switch (type) {
    case 5120:
      return normalized ? std::max(number<int8_t>(at) / 127.0, -1.0) : number<int8_t>(at);
    case 5121:
      return normalized ? number<uint8_t>(at) / 255.0 : number<uint8_t>(at);
    case 5122:
      return normalized ? std::max(number<int16_t>(at) / 32767.0, -1.0) : number<int16_t>(at);
    case 5123:
      return normalized ? number<uint16_t>(at) / 65535.0 : number<uint16_t>(at);
    case 5125:
      return number<uint32_t>(at);
    default:
      return number<float>(at);
  }
}

size_t bytesOf(int type) {
  return type < 5122 ? 1 : type < 5124 ? 2 : 4;
}

size_t componentsOf(const std::string& type) {
  return type == "SCALAR" ? 1 : type == "MAT4" ? 16 : static_cast<size_t>(type[3] - '0');
}

glm::dmat4 fromTrs(const std::vector<double>& t, std::vector<double> r,
                   const std::vector<double>& s) {
  const double length = std::sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + r[3] * r[3]);
  for (double& c : r) c /= length;
  const double x = r[0], y = r[1], z = r[2], w = r[3];
  glm::dmat4 m(1);
  m[0] = s[0] * glm::dvec4(1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w), 0);
  m[1] = s[1] * glm::dvec4(2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w), 0);
  m[2] = s[2] * glm::dvec4(2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y), 0);
  m[3] = glm::dvec4(t[0], t[1], t[2], 1);
  return m;
}

glm::dmat4 fromColumns(const double* numbers) {
  glm::dmat4 m(1);
  for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = numbers[i];
  return m;
}

}  // namespace

ReferenceGltf::ReferenceGltf(const std::string& path) {
  const std::string bytes = contentOf(path);
  std::string text = bytes, binary;
  if (bytes.starts_with("glTF")) {
    uint32_t length = 0;
    std::memcpy(&length, &bytes[12], 4);
    text = bytes.substr(20, length);
    if (bytes.size() > 28 + length) binary = bytes.substr(28 + length);
  }
  document_ = json::parse(text);
  for (const json& buffer : document_.value("buffers", json::array())) {
    const std::string uri = buffer.value("uri", "");
    buffers_.push_back(uri.empty() ? binary
                       : uri.starts_with("data:")
                           ? decoded(uri.substr(uri.find(',') + 1))
                           : contentOf(std::filesystem::path(path).parent_path() / uri));
  }
  nodes_ = document_["nodes"];
  parents_.resize(nodes_.size(), -1);
  for (size_t i = 0; i < nodes_.size(); ++i) {
    for (const size_t child : nodes_[i].value("children", std::vector<size_t>())) {
      parents_[child] = static_cast<int>(i);
    }
  }
}

std::vector<double> ReferenceGltf::accessor(size_t index) const {
  const json& a = document_["accessors"][index];
  const int type = a["componentType"];
  const bool normalized = a.value("normalized", false);
  const size_t components = componentsOf(a["type"]), count = a["count"];
  std::vector<double> result(components * count, 0.0);
  const auto view = [&](const json& from, size_t size) {
    const json& v = document_["bufferViews"][from["bufferView"].get<size_t>()];
    const size_t stride = v.value("byteStride", size);
    return std::pair(buffers_[v["buffer"].get<size_t>()].data() + v.value("byteOffset", size_t{0}) +
                         from.value("byteOffset", size_t{0}),
                     stride);
  };
  const size_t element = components * bytesOf(type);
  const auto read = [&](const char* at, size_t to) {
    for (size_t c = 0; c < components; ++c) {
      result[to * components + c] = component(at + c * bytesOf(type), type, normalized);
    }
  };
  if (a.contains("bufferView")) {
    const auto [first, stride] = view(a, element);
    for (size_t i = 0; i < count; ++i) read(first + i * stride, i);
  }
  if (a.contains("sparse")) {
    const json& sparse = a["sparse"];
    const int indexType = sparse["indices"]["componentType"];
    const auto where = view(sparse["indices"], bytesOf(indexType)).first;
    const auto what = view(sparse["values"], element).first;
    for (size_t i = 0; i < sparse["count"].get<size_t>(); ++i) {
      read(what + i * element,
           static_cast<size_t>(component(where + i * bytesOf(indexType), indexType, false)));
    }
  }
  return result;
}

double ReferenceGltf::duration(size_t animation) const {
  double last = 0;
  const json& a = document_["animations"][animation];
  for (const json& channel : a["channels"]) {
    if (!channel["target"].contains("node")) continue;
    last =
        std::max(last, accessor(a["samplers"][channel["sampler"].get<size_t>()]["input"]).back());
  }
  return last;
}

// Appendix C.
std::vector<double> ReferenceGltf::sampled(const json& sampler, double seconds,
                                           bool rotation) const {
  const std::vector<double> times = accessor(sampler["input"]),
                            values = accessor(sampler["output"]);
  const std::string kind = sampler.value("interpolation", "LINEAR");
  const size_t parts = kind == "CUBICSPLINE" ? 3 : 1, width = values.size() / times.size() / parts;
  const auto value = [&](size_t key, size_t part) {
    const auto first = values.begin() + static_cast<std::ptrdiff_t>((key * parts + part) * width);
    return std::vector<double>(first, first + static_cast<std::ptrdiff_t>(width));
  };
  const size_t middle = parts / 2;
  seconds = std::clamp(seconds, times.front(), times.back());
  size_t key = 0;
  while (key + 1 < times.size() && times[key + 1] <= seconds) ++key;
  std::vector<double> result = value(key, middle);
  if (key + 1 == times.size() || kind == "STEP") return result;
  const double td = times[key + 1] - times[key], t = (seconds - times[key]) / td;
  const std::vector<double> next = value(key + 1, middle);
  if (kind == "CUBICSPLINE") {
    const std::vector<double> b = value(key, 2), a = value(key + 1, 0);
    for (size_t i = 0; i < width; ++i) {
      result[i] = (2 * t * t * t - 3 * t * t + 1) * result[i] +
                  td * (t * t * t - 2 * t * t + t) * b[i] + (-2 * t * t * t + 3 * t * t) * next[i] +
                  td * (t * t * t - t * t) * a[i];
    }
    return result;
  }
  double from = 1 - t, to = t;
  if (rotation) {
    double dot = 0;
    for (size_t i = 0; i < 4; ++i) dot += result[i] * next[i];
    const double a = std::acos(std::min(1.0, std::abs(dot))), s = dot < 0 ? -1 : 1;
    if (std::sin(a) > 1e-9) {
      from = std::sin(a * (1 - t)) / std::sin(a);
      to = std::sin(a * t) / std::sin(a);
    }
    to *= s;
  }
  for (size_t i = 0; i < width; ++i) result[i] = from * result[i] + to * next[i];
  return result;
}

void ReferenceGltf::pose(std::optional<size_t> animation, double seconds) {
  nodes_ = document_["nodes"];
  if (!animation) return;
  const json& a = document_["animations"][*animation];
  for (const json& channel : a["channels"]) {
    const json& target = channel["target"];
    if (!target.contains("node")) continue;
    const std::string path = target["path"];
    nodes_[target["node"].get<size_t>()][path] =
        sampled(a["samplers"][channel["sampler"].get<size_t>()], seconds, path == "rotation");
  }
}

glm::dmat4 ReferenceGltf::local(size_t node) const {
  const json& n = nodes_[node];
  if (n.contains("matrix")) return fromColumns(n["matrix"].get<std::vector<double>>().data());
  return fromTrs(n.value("translation", std::vector<double>{0, 0, 0}),
                 n.value("rotation", std::vector<double>{0, 0, 0, 1}),
                 n.value("scale", std::vector<double>{1, 1, 1}));
}

glm::dmat4 ReferenceGltf::world(size_t node) const {
  glm::dmat4 result = local(node);
  for (int up = parents_[node]; up >= 0; up = parents_[static_cast<size_t>(up)]) {
    result = local(static_cast<size_t>(up)) * result;
  }
  return result;
}

// 3.7.2.2 and 3.7.3: morph targets first, then the skin. World space if a skin moves them, else
// that of the node.
std::vector<glm::dvec3> ReferenceGltf::vertices(size_t node, const json& primitive) const {
  const json& attributes = primitive["attributes"];
  std::vector<double> p = accessor(attributes["POSITION"]);
  const json& mesh = document_["meshes"][nodes_[node]["mesh"].get<size_t>()];
  const std::vector<double> weights =
      nodes_[node].value("weights", mesh.value("weights", std::vector<double>()));
  for (size_t k = 0; k < weights.size(); ++k) {
    const json& target = primitive["targets"][k];
    if (!target.contains("POSITION")) continue;
    const std::vector<double> delta = accessor(target["POSITION"]);
    for (size_t i = 0; i < p.size(); ++i) p[i] += weights[k] * delta[i];
  }
  std::vector<glm::dvec3> result(p.size() / 3);
  for (size_t i = 0; i < result.size(); ++i) result[i] = {p[3 * i], p[3 * i + 1], p[3 * i + 2]};
  if (!nodes_[node].contains("skin") || !attributes.contains("JOINTS_0")) return result;
  const json& skin = document_["skins"][nodes_[node]["skin"].get<size_t>()];
  std::vector<glm::dmat4> joints;
  std::vector<double> binds;
  if (skin.contains("inverseBindMatrices")) binds = accessor(skin["inverseBindMatrices"]);
  for (const size_t joint : skin["joints"]) {
    glm::dmat4 m = world(joint);
    if (!binds.empty()) m = m * fromColumns(&binds[16 * joints.size()]);
    joints.push_back(m);
  }
  std::vector<glm::dmat4> sums(result.size(), glm::dmat4(0));
  std::vector<double> totals(result.size(), 0.0);
  for (int n = 0; attributes.contains("JOINTS_" + std::to_string(n)); ++n) {
    const std::vector<double> j = accessor(attributes["JOINTS_" + std::to_string(n)]),
                              w = accessor(attributes["WEIGHTS_" + std::to_string(n)]);
    for (size_t i = 0; i < w.size(); ++i) {
      sums[i / 4] += w[i] * joints[static_cast<size_t>(j[i])];
      totals[i / 4] += w[i];
    }
  }
  for (size_t i = 0; i < result.size(); ++i) {
    result[i] = glm::dvec3(sums[i] * glm::dvec4(result[i], 1)) / totals[i];
  }
  return result;
}

void ReferenceGltf::visit(size_t node, std::vector<std::vector<glm::dvec3>>& to) const {
  const json& n = nodes_[node];
  std::vector<glm::dmat4> instances{glm::dmat4(1)};
  if (n.contains("/extensions/EXT_mesh_gpu_instancing"_json_pointer)) {
    const json& a = n["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
    instances.clear();
    const size_t count = document_["accessors"][a.begin()->get<size_t>()]["count"];
    for (size_t i = 0; i < count; ++i) {
      const auto part = [&](const char* name, const std::vector<double>& missing) {
        if (!a.contains(name)) return missing;
        const std::vector<double> all = accessor(a[name]);
        const size_t width = missing.size();
        const auto first = all.begin() + static_cast<std::ptrdiff_t>(i * width);
        return std::vector<double>(first, first + static_cast<std::ptrdiff_t>(width));
      };
      instances.push_back(fromTrs(part("TRANSLATION", {0, 0, 0}), part("ROTATION", {0, 0, 0, 1}),
                                  part("SCALE", {1, 1, 1})));
    }
  }
  for (size_t k = 0; n.contains("mesh") && k < instances.size(); ++k) {
    for (const json& primitive : document_["meshes"][n["mesh"].get<size_t>()]["primitives"]) {
      if (primitive.value("mode", 4) != 4) continue;
      const std::vector<glm::dvec3> p = vertices(node, primitive);
      const bool skinned = n.contains("skin") && primitive["attributes"].contains("JOINTS_0");
      const glm::dmat4 map = skinned ? glm::dmat4(1) : world(node) * instances[k];
      std::vector<glm::dvec3>& corners = to.emplace_back();
      std::vector<double> indices;
      if (primitive.contains("indices")) indices = accessor(primitive["indices"]);
      for (size_t i = 0; i < (indices.empty() ? p.size() : indices.size()); ++i) {
        const size_t index = indices.empty() ? i : static_cast<size_t>(indices[i]);
        corners.emplace_back(map * glm::dvec4(p[index], 1));
      }
    }
  }
  for (const size_t child : n.value("children", std::vector<size_t>())) visit(child, to);
}

std::vector<std::vector<glm::dvec3>> ReferenceGltf::corners() const {
  std::vector<std::vector<glm::dvec3>> result;
  const json& scene = document_["scenes"][document_.value("scene", size_t{0})];
  for (const size_t root : scene["nodes"]) visit(root, result);
  return result;
}

}  // namespace grisaille::scene
