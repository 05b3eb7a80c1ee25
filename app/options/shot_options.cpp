// SPDX-License-Identifier: MIT
#include "app/options/shot_options.h"

#include <charconv>
#include <glm/gtc/color_space.hpp>

#include "core/base/error.h"
#include "core/shots/shot_file.h"

namespace grisaille::app {
namespace {

// The whole of `text` as a number of the given base.
template <typename T>
bool parse(std::string_view text, T& value, int base = 10) {
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value, base);
  return result.ec == std::errc() && result.ptr == end && !text.empty();
}

struct Fire {
  glm::uvec2 pixel = glm::uvec2(0);
  glm::vec3 color = glm::vec3(0);  // linear
};

// "640,360,#ff8000": a pixel of the picture, an sRGB colour.
Fire parseFire(const std::string& text, glm::uvec2 size) {
  const size_t first = text.find(',');
  const size_t second = first == std::string::npos ? first : text.find(',', first + 1);
  const auto wrong = [&]() -> Error {
    return {ErrorId::kUsage, "--fire '{}' is not of the form X,Y,#rrggbb", text};
  };
  if (second == std::string::npos) throw wrong();
  Fire fire;
  const std::string_view all = text;
  const std::string_view color = all.substr(second + 1);
  uint32_t bits = 0;
  if (!parse(all.substr(0, first), fire.pixel.x) ||
      !parse(all.substr(first + 1, second - first - 1), fire.pixel.y) || color.size() != 7 ||
      color[0] != '#' || !parse(color.substr(1), bits, 16)) {
    throw wrong();
  }
  if (fire.pixel.x >= size.x || fire.pixel.y >= size.y) {
    throw Error(ErrorId::kUsage, "--fire '{}' is outside the picture of {}x{} pixels", text, size.x,
                size.y);
  }
  fire.color =
      glm::convertSRGBToLinear(glm::vec3(bits >> 16, bits >> 8 & 255u, bits & 255u) * (1.0f / 255));
  return fire;
}

void checkTakesShots(const effect::Effect& effect) {
  if (!effect.takesShots()) {
    throw Error(ErrorId::kEffectTakesNoShots, "effect '{}' takes no shots", effect.desc->key);
  }
}

}  // namespace

void ShotOptions::addTo(CLI::App& command) {
  command.add_option("--load", loads, "Shots for an effect that takes them, as .json or .shots")
      ->type_name("EFFECT=FILE")
      ->allow_extra_args(false);
  command
      .add_option("--fire", fires,
                  "Fire a shot from the camera through a pixel (from the top left), after what is "
                  "loaded")
      ->type_name("X,Y,#rrggbb")
      ->allow_extra_args(false);
  command.add_option("--save", saves, "Save an effect's shots, as .json or .shots")
      ->type_name("EFFECT=FILE")
      ->allow_extra_args(false);
  command
      .add_option("--coverage", coverage,
                  "CSV of the share of the visible surface that each colour holds; -: to standard "
                  "output")
      ->type_name("FILE.csv|-");
}

Shots::File Shots::parseFile(const std::string& text, ActiveEffects& active) {
  const size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) {
    throw Error(ErrorId::kUsage, "'{}' is not of the form EFFECT=FILE", text);
  }
  File file{.effect = text.substr(0, equals), .path = text.substr(equals + 1)};
  checkTakesShots(active.values(file.effect).effect());
  return file;
}

Shots::Shots(const ShotOptions& options, ActiveEffects& active, const scene::Camera& camera,
             glm::uvec2 size) {
  for (const std::string& text : options.saves) {
    saves_.push_back(parseFile(text, active));
    shots::checkEnding(saves_.back().path);
  }
  for (const effect::Effect* effect : active.effects()) {
    if (effect->takesShots()) lists_.try_emplace(effect->desc->key);
  }
  for (const std::string& text : options.loads) {
    const File file = parseFile(text, active);
    lists_.find(file.effect)->second.fire(shots::load(file.path));
  }
  if (!options.fires.empty() && lists_.empty()) {
    throw Error(ErrorId::kEffectTakesNoShots, "--fire is given, but no active effect takes shots");
  }
  for (const std::string& text : options.fires) {
    const Fire fire = parseFire(text, size);
    const glm::dvec3 direction =
        scene::pixelDirection(camera, size.x, size.y, glm::dvec2(fire.pixel) + 0.5);
    const glm::vec3 unit(glm::normalize(direction));
    const grisaille_shot shot = {.origin = {camera.eye.x, camera.eye.y, camera.eye.z},
                                 .direction = {unit.x, unit.y, unit.z},
                                 .color = {fire.color.x, fire.color.y, fire.color.z},
                                 .range = 0,
                                 .reserved = 0};
    for (auto& [effect, list] : lists_) list.fire(shot);
  }
}

std::span<const grisaille_shot> Shots::of(std::string_view effect) const {
  const auto found = lists_.find(effect);
  return found == lists_.end() ? std::span<const grisaille_shot>{} : found->second.shots();
}

void Shots::save() const {
  for (const File& file : saves_) shots::save(of(file.effect), file.path);
}

}  // namespace grisaille::app
