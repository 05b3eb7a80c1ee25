// SPDX-License-Identifier: MIT
// Which effects run, in which order and with what values: data that can be copied and compared.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/effect/parameter_name.h"
#include "core/effect/registry.h"
#include "core/effect/values.h"

namespace grisaille::effect {

class Selection {
 public:
  struct Entry {
    bool on = false;
    Values values;

    const char* key() const { return values.effect().desc->key; }
    const Effect& effect() const { return values.effect(); }
  };

  // The same without pointers into plugins: what undo keeps while plugins come and go. Values are
  // as Values::text() has them, which loses nothing.
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

  Selection() = default;
  // All effects of the registry, by key, off, with defaults. The registry outlives the selection
  // and scans nothing meanwhile.
  explicit Selection(const Registry& registry);
  // These effects, on, in this order, with defaults. Throws kEffectUnknown, kEffectTwice.
  Selection(const Registry& registry, std::span<const std::string> keys);

  std::vector<Entry>& entries() { return entries_; }
  const std::vector<Entry>& entries() const { return entries_; }

  // Null: there is none. Good until the order changes.
  Entry* find(std::string_view key);
  const Entry* find(std::string_view key) const;

  // Of an effect that is on. Throws kEffectUnknown.
  Values& values(std::string_view key);
  // Throws as values() and Values::set() do.
  void set(const Assignment& assignment) {
    values(assignment.name.effect).set(assignment.name.key, assignment.value);
  }

  void set(const ParameterValue& one) { values(one.name.effect).set(one.name.key, one.value); }

  // Those that are on, in order.
  std::vector<const Effect*> effects() const;

  // The effect at `from` gets the index `to`; those between close up. Nothing happens where either
  // is no index.
  void move(size_t from, size_t to);

  State state() const;

  // By the keys of effects and parameters. What the state does not name of an effect that it names
  // gets its default; effects that it does not name stay behind the others, off, with their values.
  // Returns a line for each effect, parameter or value that no longer exists or fits.
  std::vector<std::string> restore(const State& state);

 private:
  const Registry* registry_ = nullptr;
  std::vector<Entry> entries_;
};

}  // namespace grisaille::effect
