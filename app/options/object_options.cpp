// SPDX-License-Identifier: MIT
#include "app/options/object_options.h"

#include <charconv>
#include <utility>

#include "app/services/placement.h"
#include "core/base/error.h"
#include "core/objects/object_file.h"

namespace grisaille::app {
namespace {

struct ForEffect {
  std::string effect, text;
};

ForEffect parse(const std::string& text, const char* form) {
  const size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) {
    throw Error(ErrorId::kUsage, "'{}' is not of the form {}", oneLine(text), form);
  }
  return {.effect = text.substr(0, equals), .text = text.substr(equals + 1)};
}

constexpr const char* kFileForm = "EFFECT=FILE.json";
constexpr const char* kAddForm = "EFFECT=X,Y[,FIELD=VALUE...] or EFFECT={...}";

objects::ObjectList& listOf(effect::Chain& chain, const std::string& effect) {
  if (chain.selection.find(effect) == nullptr) chain.selection.values(effect);  // throws
  objects::ObjectList* list = chain.objects(effect);
  if (list != nullptr) return *list;
  throw Error(ErrorId::kEffectTakesNoObjects, "effect '{}' has no objects", effect);
}

// Splits at commas.
std::vector<std::string_view> partsOf(std::string_view text) {
  std::vector<std::string_view> parts;
  for (size_t at = 0; at <= text.size();) {
    const size_t comma = std::min(text.find(',', at), text.size());
    parts.push_back(text.substr(at, comma - at));
    at = comma + 1;
  }
  return parts;
}

uint32_t pixelOf(std::string_view text, uint32_t size, const std::string& option) {
  uint32_t pixel = 0;
  const char* end = text.data() + text.size();
  const auto [last, status] = std::from_chars(text.data(), end, pixel);
  if (status != std::errc() || last != end) {
    throw Error(ErrorId::kUsage, "--add '{}' is not of the form {}", oneLine(option), kAddForm);
  }
  if (pixel < size) return pixel;
  throw Error(ErrorId::kUsage, "--add '{}' lies outside the picture; give a pixel from 0 to {}",
              oneLine(option), size - 1);
}

// Parses "640,360,color=#ff8000": a pixel, counted from the picture's top left corner, and fields.
objects::Object placedObject(const std::string& option, std::string_view text,
                             const objects::Table& table, const scene::Camera& camera,
                             glm::uvec2 size, effect::RayService& rays) {
  const std::vector<std::string_view> parts = partsOf(text);
  if (parts.size() < 2) {
    throw Error(ErrorId::kUsage, "--add '{}' is not of the form {}", oneLine(option), kAddForm);
  }
  const glm::uvec2 pixel(pixelOf(parts[0], size.x, option), pixelOf(parts[1], size.y, option));
  auto object =
      placedAt(glm::dvec2(pixel) + 0.5, size, camera, rays, table, objects::Object(table));
  if (!object) {
    throw Error(ErrorId::kUsage, "--add '{}': no surface is visible at this pixel; give another",
                oneLine(option));
  }
  for (const std::string_view part : std::span(parts).subspan(2)) {
    const size_t equals = part.find('=');
    if (equals == std::string_view::npos) {
      throw Error(ErrorId::kUsage, "--add '{}' is not of the form {}", oneLine(option), kAddForm);
    }
    const objects::Field& field = objects::fieldOf(table, part.substr(0, equals));
    object->at(table, field.key) = objects::parseValue(field, part.substr(equals + 1));
  }
  return *object;
}

}  // namespace

void ObjectOptions::addTo(CLI::App& command) {
  command.add_option("--load", loads, "Load objects of an effect from a file that --save wrote")
      ->type_name("EFFECT=FILE.json")
      ->allow_extra_args(false);
  command
      .add_option(
          "--add", adds,
          "Add an object after those of --load: at a pixel, counted from the top left, with "
          "values of its fields; or as the JSON of an object file; see `grisaille effects`")
      ->type_name("EFFECT=X,Y[,FIELD=VALUE...]|EFFECT={...}")
      ->allow_extra_args(false);
  command.add_option("--save", saves, "Save the objects of an effect to a file")
      ->type_name("EFFECT=FILE.json")
      ->allow_extra_args(false);
}

void ObjectOptions::check(effect::Chain& chain) const {
  for (const std::string& text : saves) {
    const ForEffect one = parse(text, kFileForm);
    listOf(chain, one.effect);
    objects::checkEnding(one.text);
  }
  for (const std::string& text : loads) listOf(chain, parse(text, kFileForm).effect);
  for (const std::string& text : adds) listOf(chain, parse(text, kAddForm).effect);
}

void ObjectOptions::load(effect::Chain& chain) const {
  for (const std::string& text : loads) {
    const ForEffect one = parse(text, kFileForm);
    objects::ObjectList& list = listOf(chain, one.effect);
    list.add(objects::load(list.table(), one.text));
  }
}

void ObjectOptions::apply(effect::Chain& chain, const scene::Camera& camera, glm::uvec2 size,
                          effect::RayService& rays) const {
  load(chain);
  for (const std::string& text : adds) {
    const ForEffect one = parse(text, kAddForm);
    objects::ObjectList& list = listOf(chain, one.effect);
    list.add(one.text.starts_with('{')
                 ? objects::parseObject(list.table(), one.text)
                 : placedObject(text, one.text, list.table(), camera, size, rays));
  }
}

void ObjectOptions::save(effect::Chain& chain) const {
  for (const std::string& text : saves) {
    const ForEffect one = parse(text, kFileForm);
    objects::save(listOf(chain, one.effect).view(), one.text);
  }
}

std::vector<NamedOutput> ObjectOptions::outputs() const {
  std::vector<NamedOutput> all;
  for (const std::string& text : saves) {
    all.push_back({"--save " + text, parse(text, kFileForm).text});
  }
  return all;
}

}  // namespace grisaille::app
