// SPDX-License-Identifier: MIT
#include "core/effect/registry.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>

#include "core/base/nearest.h"
#include "core/effect/probe.h"
#include "core/effect/shared_library.h"
#include "core/effect/struct_version.h"
#include "core/effect/values.h"

namespace grisaille::effect {
namespace fs = std::filesystem;
namespace {

void checkAbi(const grisaille_plugin_desc& plugin) {
  if (plugin.magic != GRISAILLE_MAGIC) {
    throw Error(ErrorId::kPluginAbi, "its description begins with {:#x}, not with {:#x}",
                plugin.magic, GRISAILLE_MAGIC);
  }
  if (plugin.abi_major != GRISAILLE_ABI_MAJOR || plugin.abi_minor > GRISAILLE_ABI_MINOR) {
    throw Error(ErrorId::kPluginAbi,
                "it was built for interface version {}.{}, but this program has {}.{}",
                plugin.abi_major, plugin.abi_minor, GRISAILLE_ABI_MAJOR, GRISAILLE_ABI_MINOR);
  }
}

// Indexed by grisaille_attachment.
constexpr std::array kAttachmentNames = {"depth",        "view_depth", "normal", "base_colour",
                                         "facet_normal", "back_depth", "motion", "thickness",
                                         "next_depth",   "colour"};
static_assert(kAttachmentNames.size() == GRISAILLE_ATTACHMENT_COUNT);

}  // namespace

std::vector<std::string> attachmentNames(uint32_t reads) {
  std::vector<std::string> names;
  for (size_t a = 0; a < kAttachmentNames.size(); ++a) {
    if ((reads & GRISAILLE_READS(a)) != 0) names.emplace_back(kAttachmentNames[a]);
  }
  return names;
}

std::vector<std::string> readNames(const Effect& effect, const double* values) {
  std::vector<std::string> names = attachmentNames(effect.reads(values, ~0u));
  for (const grisaille_input_desc& input : effect.inputs()) names.emplace_back(input.key);
  return names;
}

struct Registry::State {
  std::vector<Effect> effects;                                      // sorted by key
  std::vector<std::unique_ptr<const grisaille_effect_desc>> descs;  // the effects point to these
  std::vector<Refused> refused;
  std::vector<Library> libraries;
  std::set<fs::path> loadedFiles;   // real paths
  std::set<fs::path> refusedFiles;  // real paths, refused in scan()

  void take(const Library& library, const std::string& path, Origin origin);
  void add(const std::string& path, Origin origin);
};

Registry::Registry() : state_(std::make_unique<State>()) {}
Registry::~Registry() = default;

void Registry::State::add(const std::string& path, Origin origin) {
  std::error_code failed;
  const fs::path real = fs::canonical(path, failed);
  if (failed) throw Error(ErrorId::kPluginUnloadable, "{}", failed.message());
  if (loadedFiles.contains(real)) return;

  if (origin == Origin::kForeign) probe(real);
  Library library = openLibrary(real.string());
  try {
    take(library, path, origin);
  } catch (...) {
    // A refused plugin stays loaded: a thread that it started while loading may still run its code.
    static_cast<void>(library.release());
    throw;
  }
  libraries.push_back(std::move(library));
  loadedFiles.insert(real);
}

void Registry::State::take(const Library& library, const std::string& path, Origin origin) {
  const auto& plugin =
      *static_cast<const grisaille_plugin_desc*>(symbolOf(library, GRISAILLE_PLUGIN_SYMBOL));
  checkAbi(plugin);
  checkTable(plugin);
  const std::span fresh(plugin.effects, plugin.effect_count);
  for (const grisaille_effect_desc* desc : fresh) {
    const auto twin = std::ranges::find_if(
        effects, [&](const Effect& e) { return std::string_view(e.desc->key) == desc->key; });
    if (twin != effects.end()) {
      throw Error(ErrorId::kPluginDuplicate, "its effect {} is already in {}", desc->key,
                  twin->path);
    }
  }
  for (const grisaille_effect_desc* desc : fresh) {
    descs.push_back(std::make_unique<const grisaille_effect_desc>(whole(desc)));
    effects.push_back({descs.back().get(), path, origin});
  }
  std::ranges::sort(effects, {}, [](const Effect& e) { return std::string_view(e.desc->key); });
}

void Registry::scan(const std::string& folder, Origin origin) {
  std::vector<std::string> paths;
  std::error_code failed;
  // increment(), not ++: an error in the middle of a folder then sets `failed` and does not throw.
  for (fs::directory_iterator file(folder, failed); !failed && file != fs::directory_iterator();
       file.increment(failed)) {
    if (file->path().extension() == ".so") paths.push_back(file->path().string());
  }
  if (failed) throw Error(ErrorId::kPluginPath, "{}: {}", folder, failed.message());
  std::ranges::sort(paths);
  for (const std::string& path : paths) {
    try {
      load(path, origin);
    } catch (const Error& reason) {
      const fs::path real = fs::weakly_canonical(path, failed);
      if (state_->refusedFiles.insert(real).second) state_->refused.push_back({path, reason});
    }
  }
}

void Registry::load(const std::string& path, Origin origin) {
  try {
    state_->add(path, origin);
  } catch (const Error& error) {
    throw Error(error.id(), "{}: {}", path, error.detail());
  }
}

std::span<const Effect> Registry::effects() const {
  return state_->effects;
}
std::span<const Refused> Registry::refused() const {
  return state_->refused;
}

std::vector<std::string> Registry::defaults() const {
  std::vector<std::string> keys;
  for (const Effect& effect : state_->effects) {
    const bool marked = (effect.desc->flags & GRISAILLE_EFFECT_DEFAULT) != 0;
    if (marked && effect.origin == Origin::kOwn) keys.emplace_back(effect.key());
  }
  return keys;
}

const Effect& Registry::find(std::string_view key) const {
  std::vector<std::string> keys;
  for (const Effect& effect : state_->effects) {
    if (key == effect.desc->key) return effect;
    keys.emplace_back(effect.desc->key);
  }
  for (const Refused& refused : state_->refused) {
    if (fs::path(refused.path).stem() == key) {
      throw Error(ErrorId::kEffectUnknown, "the plugin of {} was refused: {}", oneLine(key),
                  refused.reason.detail());
    }
  }
  const std::string near = nearest(key, keys);
  throw Error(ErrorId::kEffectUnknown, "there is no effect \"{}\"{}", oneLine(key),
              near.empty() ? "" : ", nearest is " + near);
}

}  // namespace grisaille::effect
