// SPDX-License-Identifier: MIT
// All effects there are, in the order they run, each on or off, with its values.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/settings/settings.h"
#include "core/effect/registry.h"
#include "core/effect/values.h"

namespace grisaille::app::viewer {

class EffectList {
 public:
  struct Entry {
    bool on = false;
    effect::Values values;

    const char* key() const { return values.effect().desc->key; }
  };

  // Plain data, comparable: what undo keeps. Values as effect::Values::text() gives them, which
  // loses nothing.
  struct State {
    struct One {
      std::string key;
      bool on = false;
      std::vector<std::pair<std::string, std::string>> values;  // key, text

      bool operator==(const One&) const = default;
    };
    std::vector<One> effects;

    bool operator==(const State&) const = default;
  };

  // By key, all off, with defaults. The registry outlives the list and scans nothing meanwhile.
  explicit EffectList(const effect::Registry& registry);

  std::vector<Entry>& entries() { return entries_; }
  const std::vector<Entry>& entries() const { return entries_; }

  // Null: there is none. Good until the order changes.
  Entry* find(std::string_view key);

  // The effect at `from` gets the index `to`; those between close up. Nothing happens where either
  // is no index.
  void move(size_t from, size_t to);

  State state() const;

  // By the keys of effects and parameters. What the state does not name of an effect that it names
  // gets its default; effects that it does not name stay behind the others, off, with their values.
  // Returns a line for each thing that there is no more, or whose value no longer fits.
  std::vector<std::string> restore(const State& state);

  // The effects that are on, in order, with all their values.
  Settings settings() const;

  // As `grisaille render --config` takes them: the effects named (kDefaultEffects where the
  // settings name none) come first, on, with defaults but for the values given, which go over the
  // presets ("ssao=fast"); the others are off, in their order, and keep their values. Throws as
  // render does, and then changes nothing.
  void apply(const Settings& settings, const std::vector<std::string>& presets = {});

  // The state of `old` among the effects of a fresh scan, whose registry is the new list's; `old`'s
  // must still live. Adds to `dropped` what restore() returns.
  static EffectList rebound(const EffectList& old, const effect::Registry& fresh,
                            std::vector<std::string>& dropped);

 private:
  const effect::Registry* registry_;
  std::vector<Entry> entries_;
};

}  // namespace grisaille::app::viewer
