// SPDX-License-Identifier: MIT
// The chain of effects: the selection, the objects that users made for each effect, and, on a
// device, an instance of each. Every command, the viewer and libgrisaille render through a chain.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/effect/instance.h"
#include "core/effect/selection.h"
#include "core/objects/object_list.h"
#include "core/objects/own_table.h"

namespace grisaille::effect {

class Chain {
 public:
  Chain() = default;
  explicit Chain(Selection chosen) : selection(std::move(chosen)) {}
  Chain(Chain&&) = default;
  Chain& operator=(Chain&&) = default;
  ~Chain() = default;

  // Between frames, callers may change it or replace it by another selection of the same registry.
  // Objects and instances belong to the effect's key.
  Selection selection;

  // --- Objects, by the effect's key. They exist whether the effect is on or off.

  // Null if the selection has no effect with this key or its table declares no objects.
  objects::ObjectList* objects(std::string_view effect);
  // The same, but also the list of an absent effect.
  objects::ObjectList* objectsEvenIfAbsent(std::string_view effect);
  // All lists that objects() has created.
  const std::map<std::string, objects::ObjectList, std::less<>>& objectLists() const {
    return lists_;
  }
  // Increases with every change of a list, and with every list that rebind() drops or converts.
  uint64_t objectsRevision() const;

  // --- On a device

  // Ends all instances and sets the device of new ones; the device must outlive them.
  void start(gpu::Maker& device);
  // Creates the missing instances of active effects. Call it outside a frame. Throws kEffectCreate.
  void create();
  // Ends all instances; create() creates new ones. Prints the exceptions of effects.
  void stop() { running_.clear(); }
  // The same as stop(), but throws kEffectRecord if an effect throws.
  void end();

  // Records one effect, which create() has created. `inputs` describes the frame; the function
  // fills in values and objects. Returns what the effect reported. Throws the errors of
  // Instance::record().
  Report record(const Selection::Entry& entry, FrameInputs inputs);

  // Computes what an active effect draws at points of surfaces, outside a frame. Objects show that
  // record() has placed. `inputs` has the points and the rays; the function fills in the others.
  // Throws kEffectCreate and the errors of Instance::drawAt().
  void drawAt(const Selection::Entry& entry, PointInputs inputs);

  // Number of resources that the instances have made and not destroyed.
  size_t resources() const;

  // --- Plugins

  // Moves the chain to a fresh registry; call it while the old registry lives. All instances end.
  // Effects that still exist keep their place, values and objects. Effects that no longer exist are
  // absent: if a later registry has them again, they come back with what they had. If an effect's
  // table of objects has changed, each object keeps the fields of the same key and type, and the
  // list starts without steps to undo. Returns one line per effect that has become absent, and per
  // value, field and object that is dropped.
  std::vector<std::string> rebind(const Registry& fresh);

  // The selection's state, with the absent effects in their places.
  Selection::State state() const;
  // Restores a state of state(), also what it says of absent effects. Returns the lines of
  // Selection::restore().
  std::vector<std::string> restore(const Selection::State& state);

 private:
  struct Running {
    std::unique_ptr<Instance> instance;
    uint64_t seen = 0;  // revision of the objects in the last frame or points without error
  };
  // An effect that the registry does not have at present.
  struct Absent {
    Selection::State::One settings;
    std::string before;  // key of the effect that ran before it; "": it was the first
    std::unique_ptr<objects::OwnTable> table = {};  // of `list`
    std::optional<objects::ObjectList> list = {};   // its objects, if there are any
  };

  // Hands values and objects over to a call of the instance.
  template <typename Inputs, typename Call>
  void offer(const Selection::Entry& entry, Inputs& inputs, const Call& call);

  Absent* findAbsent(std::string_view effect);
  void loseList(const std::string& effect, objects::ObjectList list,
                std::vector<std::string>& dropped);
  objects::ObjectList moved(objects::ObjectList list, const objects::Table& table,
                            std::vector<std::string>& dropped);

  gpu::Maker* device_ = nullptr;
  uint64_t endedRevisions_ = 0;                                    // sum over dropped lists
  std::map<std::string, objects::ObjectList, std::less<>> lists_;  // by effect
  std::map<std::string, Running, std::less<>> running_;            // by effect
  std::vector<Absent> absent_;                                     // in their order
};

// Starts a chain on a device for its own lifetime: the instances end before the device.
class StartedChain {
 public:
  StartedChain(Chain& chain, gpu::Maker& device) : chain_(chain) { chain_.start(device); }
  ~StartedChain() { chain_.stop(); }
  StartedChain(const StartedChain&) = delete;
  StartedChain& operator=(const StartedChain&) = delete;

 private:
  Chain& chain_;
};

// Width in pixels of the guard band that an effect wants with these values, for a picture of
// `height` pixels.
uint32_t guardBand(const Values& values, uint32_t height);

}  // namespace grisaille::effect
