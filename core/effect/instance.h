// SPDX-License-Identifier: MIT
// One instance of an effect on one device.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>

#include "core/effect/registry.h"
#include "core/gpu/device.h"
#include "core/objects/object.h"

namespace grisaille::effect {

// kNone for a number that is not a grisaille_format.
gpu::Format formatOf(uint32_t format);

// Casts an effect's rays through the scene.
class RayService {
 public:
  virtual ~RayService() = default;

  // Writes one hit per ray. The rays are within the limits of grisaille_ray. Throws Error.
  virtual void cast(std::span<const grisaille_ray> rays, std::span<grisaille_hit> hits) = 0;
};

// Draws depth pictures for effects.
class DepthService {
 public:
  virtual ~DepthService() = default;

  // See grisaille_host::draw_depth. The view is within its limits. Throws Error.
  virtual void draw(const grisaille_depth_view& view, std::span<float> depth) = 0;
};

// Decodes picture files for effects.
class PictureService {
 public:
  virtual ~PictureService() = default;

  // See grisaille_host::read_picture. Throws Error if the file cannot be read.
  virtual void read(const char* path, grisaille_picture& out) = 0;
};

// The services that the host offers; null: not offered.
struct Services {
  RayService* rays = nullptr;
  DepthService* depths = nullptr;
  PictureService* pictures = nullptr;
};

// The inputs of one record(), valid during the call.
struct FrameInputs {
  gpu::Commands* commands = nullptr;
  uint32_t width = 0;
  uint32_t height = 0;
  uint32_t guard = 0;  // see grisaille_frame
  const grisaille_view* view = nullptr;
  gpu::BufferRange viewBlock;
  std::array<gpu::Texture, GRISAILLE_ATTACHMENT_COUNT> attachments;
  std::span<const gpu::Texture> outputs;                      // one per output; null: not wanted
  std::span<const gpu::Texture> named = {};                   // one per input; null: missing
  double patience = std::numeric_limits<double>::infinity();  // see grisaille_frame
  Services services = {};

  // The chain fills these in.
  std::span<const double> values = {};
  objects::View objects = {};  // for effects whose table declares objects
  size_t objectsKept = 0;      // see grisaille_objects::kept
};

// The inputs of one drawAt(), valid during the call.
struct PointInputs {
  std::span<const grisaille_point> points;  // within the limits of grisaille_point
  std::span<grisaille_drawn> drawn;         // one per point
  RayService* rays = nullptr;               // null: not offered

  // The chain fills these in.
  std::span<const double> values = {};
  objects::View objects = {};
  size_t objectsKept = 0;
};

// What an effect reported in a frame.
struct Report {
  uint64_t waiting = 0;  // pieces of work for a later frame; 0: the picture is complete
  uint64_t givenUp = 0;  // objects for which a limit leaves no room
  uint64_t coarser = 0;  // objects that are drawn less exactly because of a limit

  Report& operator+=(const Report& other) {
    waiting += other.waiting;
    givenUp += other.givenUp;
    coarser += other.coarser;
    return *this;
  }
};

class Instance {
 public:
  // Throws kEffectCreate with the effect's message.
  Instance(gpu::Maker& device, const Effect& effect);
  ~Instance();
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  // Destroys the effect's instance; do not call record() afterwards. Throws kEffectRecord if the
  // effect throws. The destructor calls end() and prints that error instead of throwing it.
  void end();

  // Records the effect's passes, labelled "<effect key>/<pass>". Throws kEffectRecord with the
  // effect's message and the number of the GPU layer's error behind it; the caller must then
  // abandon the frame. Call it at most once between the device's begin() and submit(): resources
  // that the effect destroys in record() stay until the next call, because this frame may use them.
  void record(const FrameInputs& inputs);

  // Computes what the effect draws at points of surfaces, between two frames. Throws
  // kEffectDrawsNoPoints if the effect cannot tell, and kEffectRecord with the effect's message, or
  // if a result is out of range.
  void drawAt(const PointInputs& inputs);

  // What the effect reported in the last record().
  const Report& report() const;
  // Number of resources that the effect has made and not destroyed.
  size_t resources() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace grisaille::effect
