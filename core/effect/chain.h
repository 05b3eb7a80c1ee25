// SPDX-License-Identifier: MIT
// The effects at work: the selection, the objects that users made for them, and, on a device, an
// instance of each. Every command, the viewer and libgrisaille hand a chain to what draws.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/effect/instance.h"
#include "core/effect/selection.h"
#include "core/objects/object_list.h"

namespace grisaille::effect {

class Chain {
 public:
  Chain() = default;
  explicit Chain(Selection chosen) : selection(std::move(chosen)) {}
  Chain(Chain&&) = default;
  Chain& operator=(Chain&&) = default;
  ~Chain() = default;

  // Free to be changed, or exchanged for another of the same registry, between frames. Objects and
  // instances stay with the effect's key.
  Selection selection;

  // --- Objects, by the effect's key. They are there whether the effect is on or off.

  // Null: the selection has no such effect, or its table declares none.
  objects::ObjectList* objects(std::string_view effect);
  // Those that were asked for so far.
  const std::map<std::string, objects::ObjectList, std::less<>>& objectLists() const {
    return lists_;
  }
  // Grows with every change of any list, and with every list that rebind() drops or converts.
  uint64_t objectsRevision() const;

  // --- On a device

  // From now on instances are on this device, which outlives them; those before end.
  void start(gpu::Maker& device);
  // Creates the instances that are missing of effects that are on. Outside of a frame. Throws
  // kEffectCreate.
  void create();
  // Ends all instances; create() creates new ones. What an effect throws is printed.
  void stop() { running_.clear(); }
  // The same, and throws kEffectRecord where an effect throws.
  void end();

  // Records one effect that was created into the frame that `inputs` describes but for values and
  // objects. Returns how many things wait to be drawn in a later frame. Throws as Instance does.
  uint64_t record(const Selection::Entry& entry, FrameInputs inputs);

  // --- Plugins

  // Takes over to a fresh registry, while the old one lives. Instances end. Effects that are still
  // there keep their place, values and objects. Where an effect's table of objects is another one,
  // each object keeps the fields of the same key and type, and the list starts without steps to
  // undo. Returns a line for each effect, value, field and object that is dropped.
  std::vector<std::string> rebind(const Registry& fresh);

 private:
  struct Running {
    std::unique_ptr<Instance> instance;
    uint64_t seen = 0;  // revision of the objects in the last frame that recorded without an error
  };

  gpu::Maker* device_ = nullptr;
  uint64_t endedRevisions_ = 0;                                    // of lists that are gone
  std::map<std::string, objects::ObjectList, std::less<>> lists_;  // by effect
  std::map<std::string, Running, std::less<>> running_;            // by effect
};

// A chain that is started on a device, as long as this lives: its instances end before the device.
class StartedChain {
 public:
  StartedChain(Chain& chain, gpu::Maker& device) : chain_(chain) { chain_.start(device); }
  ~StartedChain() { chain_.stop(); }
  StartedChain(const StartedChain&) = delete;
  StartedChain& operator=(const StartedChain&) = delete;

 private:
  Chain& chain_;
};

// The guard band that an effect wants with these values about a picture so high, pixels.
uint32_t guardBand(const Values& values, uint32_t height);

}  // namespace grisaille::effect
