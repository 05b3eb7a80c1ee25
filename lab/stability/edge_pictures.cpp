// SPDX-License-Identifier: MIT
#include "lab/stability/edge_pictures.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "lab/stability/comparison.h"

namespace grisaille::lab::stability {
namespace {

namespace fs = std::filesystem;

constexpr uint32_t kSmallest = 32, kLargest = 200;  // pixels per side
constexpr uint32_t kZoom = 4, kGap = 8;

glm::vec3 shown(const Case& one, const image::Image& picture, uint32_t x, uint32_t y) {
  if (picture.channels == 1) return glm::vec3(picture.at(x, y));
  const glm::vec3 colour(picture.at(x, y, 0), picture.at(x, y, 1), picture.at(x, y, 2));
  if (one.output == "bent_normal") return 0.5f * colour + 0.5f;
  if (one.output != "paint") return colour;
  return glm::mix(glm::vec3(0.6f), colour, picture.at(x, y, 3));
}

void put(image::Image& on, uint32_t panel, const Case& one, const image::Image& picture) {
  for (uint32_t y = 0; y < one.size.y * kZoom; ++y) {
    for (uint32_t x = 0; x < one.size.x * kZoom; ++x) {
      const glm::vec3 colour = shown(one, picture, x / kZoom, y / kZoom);
      const size_t to = size_t{y} * on.width + panel * (one.size.x * kZoom + kGap) + x;
      for (int c = 0; c < 3; ++c) on.pixels[to * 3 + static_cast<size_t>(c)] = colour[c];
    }
  }
}

}  // namespace

std::optional<size_t> worstOf(const Sweep& sweep, const std::string& edge) {
  std::optional<size_t> worst;
  const auto share = [&](size_t i) { return sweep.results[i].backends.at(0).oracle.shareOver; };
  for (size_t i = 0; i < sweep.cases.size(); ++i) {
    const Case& one = sweep.cases[i];
    if (one.edge != edge || std::max(one.size.x, one.size.y) > kLargest ||
        std::min(one.size.x, one.size.y) < kSmallest) {
      continue;
    }
    if (!sweep.results[i].backends.at(0).error.empty() || share(i) == 0) continue;
    if (!worst || share(i) > share(*worst)) worst = i;
  }
  return worst;
}

std::string edgePictureName(const std::string& edge) {
  std::string name = edge;
  std::erase(name, '\'');
  std::ranges::replace_if(
      name, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '-');
  return "pictures/stability/" + name + ".png";
}

void writeEdgePictures(const std::string& folder, Runner& runner, const Sweep& sweep) {
  for (const Edge& edge : edges()) {
    const auto worst = worstOf(sweep, edge.key);
    if (!worst) continue;
    const Case& one = sweep.cases[*worst];
    const Compared compared = runner.compare(one);
    image::Image off{.width = one.size.x, .height = one.size.y, .channels = 1, .pixels = {}};
    for (const float d : differences(compared.picture, compared.expected)) {
      off.pixels.push_back(d > static_cast<float>(kTolerance) ? 0 : 1);
    }
    image::Image all{.width = 3 * one.size.x * kZoom + 2 * kGap,
                     .height = one.size.y * kZoom,
                     .channels = 3,
                     .pixels = {}};
    all.pixels.assign(size_t{3} * all.width * all.height, 1);
    put(all, 0, one, compared.picture);
    put(all, 1, one, compared.expected);
    put(all, 2, one, off);
    const fs::path file = fs::path(folder) / edgePictureName(edge.key);
    std::error_code failed;
    fs::create_directories(file.parent_path(), failed);
    image::write(all, file.string());
  }
}

}  // namespace grisaille::lab::stability
