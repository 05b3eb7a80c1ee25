// SPDX-License-Identifier: MIT
// The effects that run, with their order and parameter values: data that can be copied and
// compared.
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

// True for a length of the scene that nobody has set: the scene determines its value.
bool followsScene(const Values& values, const grisaille_param_desc& param);

class Selection {
 public:
  struct Entry {
    bool on = false;
    Values values;

    const char* key() const { return values.effect().desc->key; }
    const Effect& effect() const { return values.effect(); }
  };

  // A selection without pointers into plugins, which undo can keep while plugins are reloaded.
  // Values are the text of Values::text(), which is lossless. Lengths that follow the scene are
  // left out.
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
  // All effects of the registry, sorted by key, off, with default values. The registry must outlive
  // the selection and load nothing in the meantime.
  explicit Selection(const Registry& registry);
  // These effects, on, in this order, with default values. Throws kEffectUnknown, kEffectTwice.
  Selection(const Registry& registry, std::span<const std::string> keys);

  std::vector<Entry>& entries() { return entries_; }
  const std::vector<Entry>& entries() const { return entries_; }

  // Null if there is no effect with this key. Valid until the order changes.
  Entry* find(std::string_view key);
  const Entry* find(std::string_view key) const;

  // The values of an effect that is on. Throws kEffectUnknown.
  Values& values(std::string_view key);
  // Throws the errors of values() and Values::set().
  void set(const Assignment& assignment) {
    values(assignment.name.effect).set(assignment.name.key, assignment.value);
  }

  void set(const ParameterValue& one) { values(one.name.effect).set(one.name.key, one.value); }

  // The effects that are on, in order.
  std::vector<const Effect*> effects() const;

  // Moves the effect at index `from` to index `to`; the effects between shift by one. Does nothing
  // if an index is out of range.
  void move(size_t from, size_t to);

  State state() const;

  // Restores a state, by the keys of effects and parameters. A parameter that the state omits gets
  // its default. Effects that the state omits move behind the others, off, and keep their values.
  // Returns one line per effect, parameter or value of the state that does not exist or fit.
  std::vector<std::string> restore(const State& state);

 private:
  const Registry* registry_ = nullptr;
  std::vector<Entry> entries_;
};

}  // namespace grisaille::effect
