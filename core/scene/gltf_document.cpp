// SPDX-License-Identifier: MIT
#include "core/scene/gltf_document.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>

#include "core/base/error.h"

namespace grisaille::scene {
namespace {

using nlohmann::json;

constexpr std::string_view kRead[] = {
    "EXT_mesh_gpu_instancing", "EXT_meshopt_compression",    "EXT_texture_webp",
    "KHR_mesh_quantization",   "KHR_draco_mesh_compression", "KHR_materials_pbrSpecularGlossiness",
    "KHR_texture_transform"};

// Extensions that touch neither geometry nor alpha nor base colour. A name that ends in "*" stands
// for all that begin like it.
constexpr std::string_view kHarmless[] = {"ADOBE_materials_*",
                                          "EXT_feature_metadata",
                                          "EXT_instance_features",
                                          "EXT_lights_*",
                                          "EXT_mesh_features",
                                          "EXT_structural_metadata",
                                          "KHR_animation_pointer",
                                          "KHR_audio*",
                                          "KHR_interactivity",
                                          "KHR_lights_*",
                                          "KHR_materials_anisotropy",
                                          "KHR_materials_clearcoat",
                                          "KHR_materials_diffuse_transmission",
                                          "KHR_materials_dispersion",
                                          "KHR_materials_emissive_strength",
                                          "KHR_materials_ior",
                                          "KHR_materials_iridescence",
                                          "KHR_materials_sheen",
                                          "KHR_materials_specular",
                                          "KHR_materials_transmission",
                                          "KHR_materials_unlit",
                                          "KHR_materials_variants",
                                          "KHR_materials_volume",
                                          "KHR_xmp*",
                                          "MSFT_audio_emitter"};

bool listed(std::span<const std::string_view> names, std::string_view name) {
  return std::ranges::any_of(names, [&](std::string_view known) {
    if (!known.ends_with('*')) return known == name;
    known.remove_suffix(1);
    return name.starts_with(known);
  });
}

// The elements of document[list] that are objects.
template <typename F>
void forEach(json& document, const char* list, F&& f) {
  const auto found = document.find(list);
  if (found == document.end() || !found->is_array()) return;
  for (json& element : *found) {
    if (element.is_object()) f(element);
  }
}

const json* member(const json& object, const char* key) {
  if (!object.is_object()) return nullptr;
  const auto found = object.find(key);
  return found == object.end() ? nullptr : &*found;
}

bool isMeshoptFallback(const json& buffer) {
  const json* extensions = member(buffer, "extensions");
  const json* meshopt =
      extensions == nullptr ? nullptr : member(*extensions, "EXT_meshopt_compression");
  const json* fallback = meshopt == nullptr ? nullptr : member(*meshopt, "fallback");
  return fallback != nullptr && *fallback == true;
}

}  // namespace

void checkExtensions(const json& document, std::vector<std::string>& notes) {
  std::set<std::string> leftOut;
  for (const char* list : {"extensionsRequired", "extensionsUsed"}) {
    const json* names = member(document, list);
    if (names == nullptr) continue;
    if (!names->is_array()) throw Error(ErrorId::kSceneInvalid, "{} is not an array", list);
    const bool required = std::string_view(list) == "extensionsRequired";
    for (size_t i = 0; i < names->size(); ++i) {
      const json& name = (*names)[i];
      const std::string text = name.is_string() ? name.get<std::string>() : name.dump();
      if (listed(kRead, text)) continue;
      if (required && (!name.is_string() || !listed(kHarmless, text))) {
        throw Error(ErrorId::kSceneExtension,
                    "{}[{}]: the scene requires the extension {}, which may change its geometry or "
                    "colours and is not supported",
                    list, i, oneLine(name.dump()));
      }
      leftOut.insert(oneLine(text));
    }
  }
  if (leftOut.empty()) return;
  std::string line;
  for (const std::string& name : leftOut) line += (line.empty() ? "left out: " : ", ") + name;
  notes.push_back(line);
}

bool Adaptation::apply(json& document) {
  giveNodes(document);
  giveInverseBinds(document);
  emptyFallbacks(document);
  giveViews(document);
  return changed_;
}

// tinygltf requires a buffer view for indices.
void Adaptation::giveViews(json& document) {
  const auto accessors = document.find("accessors");
  if (accessors == document.end() || !accessors->is_array()) return;
  std::set<size_t> viewless;
  forEach(document, "meshes", [&](json& mesh) {
    forEach(mesh, "primitives", [&](json& primitive) {
      const json* indices = member(primitive, "indices");
      if (indices == nullptr || !indices->is_number_unsigned()) return;
      const auto index = indices->get<uint64_t>();
      if (index >= accessors->size() || !(*accessors)[index].is_object()) return;
      if (!(*accessors)[index].contains("bufferView")) viewless.insert(index);
    });
  });
  if (viewless.empty()) return;
  json& views = document["bufferViews"];
  if (!views.is_array()) views = json::array();
  for (const size_t index : viewless) (*accessors)[index]["bufferView"] = views.size();
  views.push_back({{"buffer", 0}, {"byteLength", 1}});
  viewless_.assign(viewless.begin(), viewless.end());
  addedView_ = changed_ = true;
}

// tinygltf requires a node for each channel. Extensions give channels other targets.
void Adaptation::giveNodes(json& document) {
  forEach(document, "animations", [&](json& animation) {
    forEach(animation, "channels", [&](json& channel) {
      const auto target = channel.find("target");
      if (target == channel.end() || !target->is_object() || target->contains("node")) return;
      (*target)["node"] = -1;
      changed_ = true;
    });
  });
}

// tinygltf requires inverse bind matrices.
void Adaptation::giveInverseBinds(json& document) {
  forEach(document, "skins", [&](json& skin) {
    if (skin.contains("inverseBindMatrices")) return;
    skin["inverseBindMatrices"] = -1;
    changed_ = true;
  });
}

// The buffers for readers that do not know EXT_meshopt_compression hold nothing that the loader
// needs, and most have no data.
void Adaptation::emptyFallbacks(json& document) {
  forEach(document, "buffers", [&](json& buffer) {
    if (!isMeshoptFallback(buffer)) return;
    buffer = {{"byteLength", 1}, {"uri", "data:application/octet-stream;base64,AA=="}};
    changed_ = true;
  });
}

void Adaptation::undo(tinygltf::Model& model) const {
  for (const size_t index : viewless_) {
    if (index < model.accessors.size()) model.accessors[index].bufferView = -1;
  }
  if (addedView_ && !model.bufferViews.empty()) model.bufferViews.pop_back();
}

}  // namespace grisaille::scene
