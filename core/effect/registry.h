// SPDX-License-Identifier: MIT
// Which effects there are: plugins found in folders, checked by table, refused by name and reason.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "core/effect/foreign_call.h"
#include "grisaille/effect.h"

namespace grisaille::effect {

// Whose a plugin is. Loading runs its code, so that those of others are tried out in a process of
// their own first: see probe.h.
enum class Origin : uint8_t { kOwn, kForeign };

// An effect of a loaded plugin. What it points to is valid while its registry lives.
struct Effect {
  const grisaille_effect_desc* desc = nullptr;  // whole, however old the plugin
  std::string path;                             // of the plugin
  Origin origin = Origin::kOwn;

  std::string_view key() const { return desc->key; }
  std::span<const grisaille_param_desc> params() const { return {desc->params, desc->param_count}; }
  std::span<const grisaille_output_desc> outputs() const {
    return {desc->outputs, desc->output_count};
  }
  // Null: users make none for it.
  const grisaille_object_desc* objects() const { return desc->objects; }
  // Which attachments it reads with these values for these outputs.
  uint32_t reads(const double* values, uint32_t wanted) const {
    return foreignCall(ErrorId::kEffectRecord, desc->key, "reads",
                       [&] { return desc->reads(values, wanted); });
  }
  // As guard_band() has it, 0 where the plugin's answer is no share.
  double guardBand(const double* values) const {
    if (desc->guard_band == nullptr) return 0;
    const double share = foreignCall(ErrorId::kEffectRecord, desc->key, "guard_band",
                                     [&] { return desc->guard_band(values); });
    return share > 0 && share <= 1 ? share : 0;
  }
};

// The names of GRISAILLE_READS' bits, as headers and messages have them: "view_depth", ...
std::vector<std::string> attachmentNames(uint32_t reads);

struct Refused {
  std::string path;
  Error reason;
};

// Throws kPluginTable with the field's path ("effects[0].params[3].hard_max"). The registry calls
// it once magic and versions fit, before anything of the plugin is called.
void checkTable(const grisaille_plugin_desc& plugin);

class Registry {
 public:
  Registry();
  ~Registry();
  Registry(const Registry&) = delete;
  Registry& operator=(const Registry&) = delete;

  // Loads every *.so of a folder, in the order of their names. Plugins that do not fit join
  // refused(), each file once. Throws kPluginPath when the folder cannot be read.
  void scan(const std::string& folder, Origin origin = Origin::kOwn);

  // Loads one plugin: all its effects or none. A file that is loaded already, by whatever path, is
  // passed over. Throws kPlugin*; what is already registered stays. A refused plugin is never
  // unloaded, as its threads may still run; a foreign one is mostly refused by probe(), before
  // anything of it is loaded here.
  void load(const std::string& path, Origin origin = Origin::kOwn);

  std::span<const Effect> effects() const;  // by key; good until the next scan() or load()
  std::span<const Refused> refused() const;

  // The keys of the program's own effects that are marked GRISAILLE_EFFECT_DEFAULT.
  std::vector<std::string> defaults() const;

  // Throws kEffectUnknown, with the nearest key, and with the reason when a plugin whose file is
  // named after the key was refused. The reference is good as long as effects().
  const Effect& find(std::string_view key) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Where plugins are looked for: `lib/grisaille/effects` beside the program's folder, then the
// folders of GRISAILLE_EFFECT_PATH (':' between), then `extra`. The first is the program's own and
// may be missing; the others not.
struct SearchPath {
  std::string folder;
  bool required = false;
  Origin origin = Origin::kForeign;
};
std::vector<SearchPath> searchPaths(std::span<const std::string> extra);

}  // namespace grisaille::effect
