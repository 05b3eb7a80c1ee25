// SPDX-License-Identifier: MIT
// One effect at work on one device.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <span>

#include "core/effect/registry.h"
#include "core/gpu/device.h"
#include "core/objects/object.h"

namespace grisaille::effect {

// kNone for a number that names no format.
gpu::Format formatOf(uint32_t format);

// Who casts an effect's rays through the scene.
class RayService {
 public:
  virtual ~RayService() = default;

  // One hit a ray. Rays are as grisaille/effect.h has them. Throws Error.
  virtual void cast(std::span<const grisaille_ray> rays, std::span<grisaille_hit> hits) = 0;
};

// Who decodes picture files for effects.
class PictureService {
 public:
  virtual ~PictureService() = default;

  // As grisaille_host.read_picture has it. Throws Error where the file cannot be read.
  virtual void read(const char* path, grisaille_picture& out) = 0;
};

// Null: not offered.
struct Services {
  RayService* rays = nullptr;
  PictureService* pictures = nullptr;
};

// What one record() works on. Everything is valid during the call.
struct FrameInputs {
  gpu::Commands* commands = nullptr;
  uint32_t width = 0;
  uint32_t height = 0;
  uint32_t guard = 0;  // as grisaille_frame has it
  const grisaille_view* view = nullptr;
  gpu::BufferRange viewBlock;
  std::array<gpu::Texture, GRISAILLE_ATTACHMENT_COUNT> attachments;
  std::span<const gpu::Texture> outputs;  // one an output; null where nobody wants it
  double patience = std::numeric_limits<double>::infinity();  // as grisaille_frame has it
  Services services = {};

  // The chain fills these in.
  std::span<const double> values = {};
  objects::View objects = {};  // for effects whose table declares objects
  size_t objectsKept = 0;      // as grisaille_objects has it
};

class Instance {
 public:
  // Throws kEffectCreate with the effect's own words.
  Instance(gpu::Maker& device, const Effect& effect);
  ~Instance();
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  // Destroys the effect, which is of no use from then on. Throws kEffectRecord where the effect
  // throws. The destructor, which calls it, prints that instead.
  void end();

  // Records the effect's passes, labelled "<effect key>/<pass>". Throws kEffectRecord with the
  // effect's own words and the layer's error that made it fail, by its number; the frame is then to
  // be abandoned. At most once between the device's begin() and submit(): what the effect destroys
  // meanwhile is kept until the next call, since this frame may use it.
  void record(const FrameInputs& inputs);

  // What waits to be drawn, as the effect counted it in the last record().
  uint64_t waiting() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace grisaille::effect
