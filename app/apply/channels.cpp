// SPDX-License-Identifier: MIT
#include "app/apply/channels.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "core/base/error.h"

namespace grisaille::app {
namespace {

std::string lower(std::string text) {
  for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  return text;
}

[[noreturn]] void refuse(const image::Picture& picture, const std::string& file,
                         const std::string& what) {
  throw Error(ErrorId::kPictureChannels, "{}: {} among the channels {}", file, what,
              fmt::join(picture.channels, ", "));
}

std::optional<size_t> find(const image::Picture& picture, const std::string& name) {
  const auto found = std::ranges::find(picture.channels, name);
  if (found == picture.channels.end()) return std::nullopt;
  return static_cast<size_t>(found - picture.channels.begin());
}

size_t named(const image::Picture& picture, const std::string& name, const std::string& file) {
  const auto found = find(picture, name);
  if (!found) refuse(picture, file, fmt::format("no channel '{}'", name));
  return *found;
}

image::Image pick(const image::Image& from, const std::vector<size_t>& channels) {
  image::Image image{.width = from.width,
                     .height = from.height,
                     .channels = static_cast<uint32_t>(channels.size()),
                     .pixels = {}};
  const size_t pixels = size_t{from.width} * from.height;
  image.pixels.reserve(pixels * channels.size());
  for (size_t i = 0; i < pixels; ++i) {
    for (const size_t channel : channels) {
      image.pixels.push_back(from.pixels[i * from.channels + channel]);
    }
  }
  return image;
}

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts;
  for (size_t from = 0; from <= text.size();) {
    const size_t end = std::min(text.find(',', from), text.size());
    parts.push_back(text.substr(from, end - from));
    from = end + 1;
  }
  return parts;
}

// The channels x, y and z of the first layer named "N" or with "normal" in its name.
std::optional<std::vector<size_t>> normalLayer(const image::Picture& picture) {
  for (const std::string& channel : picture.channels) {
    const size_t dot = channel.rfind('.');
    if (dot == std::string::npos) continue;
    const std::string layer = channel.substr(0, dot);
    if (lower(layer) != "n" && lower(layer).find("normal") == std::string::npos) continue;
    for (const auto& [x, y, z] : {std::tuple("X", "Y", "Z"), std::tuple("x", "y", "z"),
                                  std::tuple("R", "G", "B"), std::tuple("r", "g", "b")}) {
      const auto a = find(picture, layer + "." + x), b = find(picture, layer + "." + y),
                 c = find(picture, layer + "." + z);
      if (a && b && c) return std::vector{*a, *b, *c};
    }
  }
  return std::nullopt;
}

// The channels with this word in their names.
std::vector<size_t> withWord(const image::Picture& picture, const std::string& word) {
  std::vector<size_t> found;
  for (size_t i = 0; i < picture.channels.size(); ++i) {
    if (lower(picture.channels[i]).find(word) != std::string::npos) found.push_back(i);
  }
  return found;
}

}  // namespace

image::Image depthChannel(const image::Picture& picture, const std::string& name,
                          const std::string& file) {
  if (!name.empty()) return pick(picture.image, {named(picture, name, file)});
  if (picture.channels.size() == 1) return picture.image;
  if (const auto z = find(picture, "Z")) return pick(picture.image, {*z});
  const std::vector<size_t> telling = withWord(picture, "depth");
  if (telling.size() != 1)
    refuse(picture, file, "no single channel is named Z or has \"depth\" in its name");
  return pick(picture.image, telling);
}

image::Image thicknessChannel(const image::Picture& picture, const std::string& file) {
  if (picture.channels.size() == 1) return picture.image;
  const std::vector<size_t> telling = withWord(picture, "thickness");
  if (telling.size() != 1) refuse(picture, file, "no single channel has \"thickness\" in its name");
  return pick(picture.image, telling);
}

image::Image normalChannels(const image::Picture& picture, const std::string& names,
                            const std::string& file) {
  if (!names.empty()) {
    std::vector<size_t> channels;
    for (const std::string& name : split(names)) channels.push_back(named(picture, name, file));
    if (channels.size() == 3) return pick(picture.image, channels);
    refuse(picture, file, fmt::format("'{}' does not name three channels", names));
  }
  if (const auto layer = normalLayer(picture)) return pick(picture.image, *layer);
  if (picture.image.channels == 3 || picture.image.channels == 4) {
    return pick(picture.image, {0, 1, 2});
  }
  refuse(picture, file, "no layer is named N or has \"normal\" in its name");
}

image::Image colourChannels(const image::Picture& picture, const std::string& file) {
  if (picture.image.channels < 3) refuse(picture, file, "no colour");
  return pick(picture.image, {0, 1, 2});
}

}  // namespace grisaille::app
