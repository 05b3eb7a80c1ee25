// SPDX-License-Identifier: MIT
#include "app/viewer/thumbnails.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string_view>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/regular_file.h"

namespace grisaille::app::viewer {
namespace {

namespace fs = std::filesystem;

constexpr uintmax_t kLargestThumbnail = 1 << 20;
constexpr float kRows = 12;  // thumbnails in the texture

// The middle of a picture in the thumbnail's shape; each pixel is the mean of those it stands for.
image::Image8 shrunk(const image::Image8& picture) {
  constexpr uint32_t kW = Thumbnails::kWidth, kH = Thumbnails::kHeight;
  const double scale = std::min(double{1} * picture.width / kW, double{1} * picture.height / kH);
  const double left = (picture.width - scale * kW) / 2, top = (picture.height - scale * kH) / 2;
  image::Image8 small{.width = kW, .height = kH, .pixels = {}};
  small.pixels.resize(size_t{kW} * kH * 4, 255);
  const auto range = [](double from, double size, uint32_t most) {
    const auto first = std::min(static_cast<uint32_t>(std::max(from, 0.0)), most - 1);
    const auto end = static_cast<uint32_t>(from + size);
    return std::pair(first, std::clamp(end, first + 1, most));
  };
  for (uint32_t y = 0; y < kH; ++y) {
    const auto [y0, y1] = range(top + y * scale, scale, picture.height);
    for (uint32_t x = 0; x < kW; ++x) {
      const auto [x0, x1] = range(left + x * scale, scale, picture.width);
      for (uint32_t c = 0; c < 3; ++c) {
        uint32_t sum = 0;
        for (uint32_t row = y0; row < y1; ++row) {
          for (uint32_t column = x0; column < x1; ++column) {
            sum += picture.pixels[(size_t{row} * picture.width + column) * 4 + c];
          }
        }
        small.pixels[(size_t{y} * kW + x) * 4 + c] =
            static_cast<uint8_t>(sum / ((y1 - y0) * (x1 - x0)));
      }
    }
  }
  return small;
}

}  // namespace

fs::path Thumbnails::fileOf(const std::string& scene) const {
  return folder_ / fmt::format("{:016x}.png", std::hash<std::string>()(scene));
}

void Thumbnails::save(const std::string& scene, const image::Image8& picture) {
  if (picture.width == 0 || picture.height == 0) return;
  const std::vector<std::byte> png = image::encodePng(shrunk(picture));
  std::error_code failed;
  fs::create_directories(folder_, failed);  // on failure, writing throws
  writeFileAtomically(fileOf(scene).string(),
                      {reinterpret_cast<const char*>(png.data()), png.size()});
}

void Thumbnails::read(const std::vector<std::string>& scenes) {
  slots_.clear();
  pictures_.width = kWidth;
  pictures_.height = kHeight * static_cast<uint32_t>(kRows);
  pictures_.texels.assign(size_t{pictures_.width} * pictures_.height * 4, std::byte{0});
  ++pictures_.revision;
  std::set<fs::path> kept;
  for (const std::string& scene : scenes) {
    const fs::path file = fileOf(scene);
    kept.insert(file);
    if (slots_.size() == static_cast<size_t>(kRows) || !whyNotRegular(file).empty()) continue;
    try {
      const std::string text = readRegularFile(file, ErrorId::kImageUnreadable, kLargestThumbnail);
      const image::Image8 picture =
          image::decode(std::as_bytes(std::span(text.data(), text.size())), file.string());
      if (picture.width != kWidth || picture.height != kHeight) continue;
      const size_t bytes = picture.pixels.size(), slot = slots_.size();
      std::ranges::copy(std::as_bytes(std::span(picture.pixels)),
                        pictures_.texels.begin() + static_cast<std::ptrdiff_t>(slot * bytes));
      slots_[scene] = slot;
    } catch (const Error&) {
      continue;  // a scene without a thumbnail
    }
  }
  std::error_code failed;
  std::vector<fs::path> old;
  for (fs::directory_iterator file(folder_, failed); !failed && file != fs::directory_iterator();
       file.increment(failed)) {
    if (file->path().extension() == ".png" && !kept.contains(file->path())) {
      old.push_back(file->path());
    }
  }
  for (const fs::path& file : old) fs::remove(file, failed);
}

void Thumbnails::draw(const std::string& scene, ImVec2 corner, ImVec2 size) const {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 end(corner.x + size.x, corner.y + size.y);
  const auto found = slots_.find(scene);
  if (found == slots_.end()) {
    list.AddRect(corner, end, ImGui::GetColorU32(ImGuiCol_TextDisabled));
    return;
  }
  const auto row = static_cast<float>(found->second);
  list.AddImage(picturesTexture(), corner, end, ImVec2(0, row / kRows),
                ImVec2(1, (row + 1) / kRows));
}

}  // namespace grisaille::app::viewer
