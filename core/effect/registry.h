// SPDX-License-Identifier: MIT
// The registry of effects: it finds plugins in folders, checks their tables, and refuses plugins
// with a reason.
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

// Whether a plugin belongs to the program or to a third party. Loading a plugin runs its code, so a
// third-party plugin is loaded in a separate process first: see probe.h.
enum class Origin : uint8_t { kOwn, kForeign };

// An effect of a loaded plugin. Its pointers are valid while its registry lives.
struct Effect {
  const grisaille_effect_desc* desc = nullptr;  // all fields present, even for an older plugin
  std::string path;                             // the plugin's file
  Origin origin = Origin::kOwn;

  std::string_view key() const { return desc->key; }
  std::span<const grisaille_param_desc> params() const { return {desc->params, desc->param_count}; }
  std::span<const grisaille_output_desc> outputs() const {
    return {desc->outputs, desc->output_count};
  }
  std::span<const grisaille_input_desc> inputs() const { return {desc->inputs, desc->input_count}; }
  // Null: the effect takes no objects.
  const grisaille_object_desc* objects() const { return desc->objects; }
  // The attachments that the effect reads with these values for these outputs.
  uint32_t reads(const double* values, uint32_t wanted) const {
    return foreignCall(ErrorId::kEffectRecord, desc->key, "reads",
                       [&] { return desc->reads(values, wanted); });
  }
  // See grisaille_effect_desc::guard_band; 0 if the plugin's result is outside 0 to 1.
  double guardBand(const double* values) const {
    if (desc->guard_band == nullptr) return 0;
    const double share = foreignCall(ErrorId::kEffectRecord, desc->key, "guard_band",
                                     [&] { return desc->guard_band(values); });
    return share > 0 && share <= 1 ? share : 0;
  }
};

// What an effect reads with these values for all its outputs: the names of attachments, and the
// keys of its inputs. Throws kEffectRecord.
std::vector<std::string> readNames(const Effect& effect, const double* values);

// The attachments' names for a combination of GRISAILLE_READS: "view_depth", ...
std::vector<std::string> attachmentNames(uint32_t reads);

struct Refused {
  std::string path;
  Error reason;
};

// Throws kPluginTable with the field's path ("effects[0].params[3].hard_max"). The registry calls
// it after checking magic and version, before it calls any function of the plugin.
void checkTable(const grisaille_plugin_desc& plugin);

class Registry {
 public:
  Registry();
  ~Registry();
  Registry(const Registry&) = delete;
  Registry& operator=(const Registry&) = delete;

  // Loads every *.so of a folder, in the order of their names. Adds refused plugins to refused(),
  // each file once. Throws kPluginPath if the folder cannot be read.
  void scan(const std::string& folder, Origin origin = Origin::kOwn);

  // Loads one plugin: all its effects or none. Skips a file that is already loaded, under any path.
  // Throws kPlugin*; registered effects stay. A refused plugin is never unloaded, because its
  // threads may still run; probe() refuses most foreign plugins before this process loads them.
  void load(const std::string& path, Origin origin = Origin::kOwn);

  std::span<const Effect> effects() const;  // sorted by key; valid until the next scan() or load()
  std::span<const Refused> refused() const;

  // The keys of the program's own effects with the flag GRISAILLE_EFFECT_DEFAULT.
  std::vector<std::string> defaults() const;

  // Throws kEffectUnknown with the nearest key, or with the reason if a plugin with that file name
  // was refused. The reference is valid as long as effects().
  const Effect& find(std::string_view key) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// The folders that are searched for plugins: `lib/grisaille/effects` beside the program's folder,
// then the folders of GRISAILLE_EFFECT_PATH (separated by ':'), then `extra`. The first holds the
// program's own plugins and may be missing; the others must exist.
struct SearchPath {
  std::string folder;
  bool required = false;
  Origin origin = Origin::kForeign;
};
std::vector<SearchPath> searchPaths(std::span<const std::string> extra);

}  // namespace grisaille::effect
