// SPDX-License-Identifier: MIT
// The types of the GPU layer: handles, formats, descriptors. Plain data, no graphics API.
//
// Every descriptor is an aggregate for designated initialisers. A field that is left out keeps its
// default. Labels appear in messages, timings and debuggers; the layer copies them. The layer reads
// spans during the call and never keeps them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "grisaille/shader.h"

namespace grisaille::gpu {

// --- Handles -------------------------------------------------------------------------------------

// 16 bits of index, 16 of generation; 0 is the null handle. A handle may outlive its resource:
// using it then throws kStaleHandle.
template <typename Tag>
struct Handle {
  uint32_t value = 0;

  uint32_t index() const { return value & 0xffffu; }
  uint32_t generation() const { return value >> 16; }
  explicit operator bool() const { return value != 0; }
  bool operator==(const Handle&) const = default;
};

using Buffer = Handle<struct BufferTag>;
using Texture = Handle<struct TextureTag>;
using Sampler = Handle<struct SamplerTag>;
using ComputePipeline = Handle<struct ComputePipelineTag>;
using GraphicsPipeline = Handle<struct GraphicsPipelineTag>;

// --- Formats -------------------------------------------------------------------------------------

enum class Format : uint8_t {
  kNone,
  kR8Unorm,
  kRgba8Unorm,
  kRgba8Srgb,
  kR16Float,
  kRgba16Float,
  kR32Float,
  kRg32Float,
  kRgba32Float,
  kR32Uint,
  kD32Float,
};

struct FormatInfo {
  const char* name;     // "r32f": the GLSL image format, or a short name of the same style
  uint32_t texelBytes;  // bytes of one texel in memory and in uploads and readbacks
  uint32_t channels;    // 1 ... 4
  bool depth;           // true: for depth targets; false: for colour targets
  bool storage;         // may be bound as an image
  bool blends;          // a target may use Blend::kOver; not every device blends 32-bit floats
};

// Valid for every format except kNone.
const FormatInfo& formatInfo(Format format);

// --- Resources -----------------------------------------------------------------------------------

// Flag sets: combine with |, test with has().
enum class BufferUsage : uint8_t { kNone = 0, kVertex = 1, kIndex = 2, kUniform = 4, kStorage = 8 };
enum class TextureUsage : uint8_t { kNone = 0, kSampled = 1, kStorage = 2, kTarget = 4 };

constexpr BufferUsage operator|(BufferUsage a, BufferUsage b) {
  return static_cast<BufferUsage>(static_cast<int>(a) | static_cast<int>(b));
}
constexpr TextureUsage operator|(TextureUsage a, TextureUsage b) {
  return static_cast<TextureUsage>(static_cast<int>(a) | static_cast<int>(b));
}
constexpr bool has(BufferUsage set, BufferUsage one) {
  return (static_cast<int>(set) & static_cast<int>(one)) != 0;
}
constexpr bool has(TextureUsage set, TextureUsage one) {
  return (static_cast<int>(set) & static_cast<int>(one)) != 0;
}

// Uploads and readbacks are always allowed.
struct BufferDesc {
  std::string_view label = {};
  uint64_t size = 0;  // bytes, 1 ... Capabilities::maxBufferBytes
  BufferUsage usage = BufferUsage::kNone;
};

// A 2D texture or, with layers > 1, a 2D array. Row 0 is the top row. Uploads and readbacks are
// always allowed. Contents are undefined until written.
struct TextureDesc {
  std::string_view label = {};
  Format format = Format::kNone;
  uint32_t width = 0;   // texels, 1 ... Capabilities::maxTextureSize
  uint32_t height = 0;  // texels
  uint32_t mips = 1;    // levels; level n is max(1, size >> n)
  uint32_t layers = 1;  // 1 ... Capabilities::maxTextureLayers
  TextureUsage usage = TextureUsage::kNone;
};

// Bytes of one layer of mip level `mip`, in uploads and readbacks.
uint64_t subresourceBytes(const TextureDesc& desc, uint32_t mip);

enum class Filter : uint8_t { kNearest, kLinear };
enum class Address : uint8_t { kClamp, kRepeat, kMirror };

struct SamplerDesc {
  std::string_view label = {};
  Filter filter = Filter::kNearest;  // within a level: minification and magnification
  Filter mipFilter = Filter::kNearest;
  Address addressU = Address::kClamp;
  Address addressV = Address::kClamp;
  float maxAnisotropy = 1;  // 1: off; clamped to Capabilities::maxAnisotropy
};

// Part of a buffer. size 0: to the end of the buffer.
struct BufferRange {
  Buffer buffer = {};
  uint64_t offset = 0;  // bytes
  uint64_t size = 0;    // bytes
};

// Part of a texture. A count of 0 means all remaining levels or layers. A view of one layer of an
// array is 2D.
struct TextureView {
  Texture texture = {};
  uint32_t mip = 0;
  uint32_t mipCount = 0;
  uint32_t layer = 0;
  uint32_t layerCount = 0;
};

// --- Pipelines -----------------------------------------------------------------------------------

using Shader = grisaille_shader;

// A value for a specialization constant: the bits of a uint, int or float; a bool is 0 or 1.
struct Specialization {
  uint32_t id = 0;
  uint32_t bits = 0;
};

struct ComputePipelineDesc {
  std::string_view label = {};
  const Shader* shader = nullptr;                  // must outlive the pipeline
  std::span<const Specialization> constants = {};  // constants not listed keep their defaults
};

// kUnorm8x4: four bytes, which the shader reads as a vec4 of 0 ... 1.
enum class AttributeFormat : uint8_t { kFloat1, kFloat2, kFloat3, kFloat4, kUnorm8x4 };

// Floats that the shader reads from one attribute: 1 ... 4.
constexpr uint32_t attributeComponents(AttributeFormat format) {
  return format == AttributeFormat::kUnorm8x4 ? 4u : static_cast<uint32_t>(format) + 1u;
}

// Bytes of one attribute.
constexpr uint32_t attributeBytes(AttributeFormat format) {
  return format == AttributeFormat::kUnorm8x4 ? 4u : 4u * attributeComponents(format);
}

struct VertexAttribute {
  uint32_t location = 0;
  uint32_t stream = 0;  // index into Draw::vertexStreams
  AttributeFormat format = AttributeFormat::kFloat3;
  uint32_t offset = 0;  // bytes from the start of the vertex
};

constexpr uint32_t kMaxVertexStreams = 4;
constexpr uint32_t kMaxColorTargets = 4;

// How fragments are blended into the target. kOver, with the fragment's straight alpha a: colour is
// src * a + dst * (1 - a), and alpha is a + dst * (1 - a).
enum class Blend : uint8_t { kNone, kOver };

// Draws triangle lists; counter-clockwise triangles face front. With a depth target, depth is
// tested with GREATER (reversed depth) and written.
struct GraphicsPipelineDesc {
  std::string_view label = {};
  const Shader* vertex = nullptr;
  const Shader* fragment = nullptr;  // null: depth only
  std::span<const Specialization> constants = {};
  std::span<const uint32_t> streamStrides = {};  // bytes, one per vertex stream
  std::span<const VertexAttribute> attributes = {};
  std::span<const Format> colorFormats = {};
  Format depthFormat = Format::kNone;
  Blend blend = Blend::kNone;  // for all colour targets; kOver needs formats that blend
};

// --- Work ----------------------------------------------------------------------------------------

// A resource bound to one slot of a shader. Make it with the functions below.
struct Binding {
  uint32_t slotClass = 0;  // grisaille_slot_class
  uint32_t slot = 0;
  BufferRange buffer = {};  // uniform, storage
  TextureView view = {};    // texture, image (one mip level)
  Sampler sampler = {};     // texture
};

inline Binding uniformBinding(uint32_t slot, BufferRange range) {
  return {.slotClass = GRISAILLE_SLOT_UNIFORM,
          .slot = slot,
          .buffer = range,
          .view = {},
          .sampler = {}};
}
inline Binding storageBinding(uint32_t slot, BufferRange range) {
  return {.slotClass = GRISAILLE_SLOT_STORAGE,
          .slot = slot,
          .buffer = range,
          .view = {},
          .sampler = {}};
}
inline Binding textureBinding(uint32_t slot, TextureView view, Sampler sampler) {
  return {.slotClass = GRISAILLE_SLOT_TEXTURE,
          .slot = slot,
          .buffer = {},
          .view = view,
          .sampler = sampler};
}
inline Binding imageBinding(uint32_t slot, Texture texture, uint32_t mip = 0) {
  return {.slotClass = GRISAILLE_SLOT_IMAGE,
          .slot = slot,
          .buffer = {},
          .view = {.texture = texture, .mip = mip, .mipCount = 1, .layer = 0, .layerCount = 0},
          .sampler = {}};
}

struct Dispatch {
  ComputePipeline pipeline = {};
  std::span<const Binding> bindings = {};
  std::array<uint32_t, 3> groups = {1, 1, 1};
};

enum class Cull : uint8_t { kNone, kBack, kFront };

// A rectangle of the targets: pixels from the top left. width 0: the whole targets.
struct Scissor {
  uint32_t x = 0;
  uint32_t y = 0;
  uint32_t width = 0;
  uint32_t height = 0;
};

struct Draw {
  GraphicsPipeline pipeline = {};
  std::span<const Binding> bindings = {};
  std::span<const BufferRange> vertexStreams = {};
  BufferRange indices = {};  // 32-bit; no buffer: a draw without indices
  uint32_t count = 0;        // indices, or vertices
  uint32_t first = 0;        // first index, or first vertex
  Cull cull = Cull::kNone;
  Scissor scissor = {};  // clips the draw; must lie inside the targets
};

// Contents of a target when drawing begins. kLoad keeps the earlier contents; after kDiscard they
// are undefined.
enum class Load : uint8_t { kClear, kLoad, kDiscard };

// `view` is one mip level of one layer (its counts are ignored).
struct ColorTarget {
  TextureView view = {};
  Load load = Load::kClear;
  std::array<float, 4> clear = {0, 0, 0, 0};  // converted to integers for kR32Uint
};

struct DepthTarget {
  TextureView view = {};  // no texture: no depth target
  Load load = Load::kClear;
  float clear = 0;  // 0 is infinitely far (reversed depth)
};

// One set of targets and the draws into it. The viewport covers the whole targets.
struct Render {
  std::span<const ColorTarget> colors = {};
  DepthTarget depth = {};
  std::span<const Draw> draws = {};  // drawn in this order
};

// --- The device ----------------------------------------------------------------------------------

struct Capabilities {
  uint32_t maxTextureSize = 0;  // texels per side
  uint32_t maxTextureLayers = 0;
  uint64_t maxBufferBytes = 0;    // of one buffer
  uint64_t maxStorageRange = 0;   // bytes of one storage binding
  uint32_t maxUniformRange = 0;   // bytes of one uniform binding, at least 65536
  uint32_t uniformAlignment = 1;  // bytes, of a uniform binding's offset
  uint32_t storageAlignment = 1;  // bytes, of a storage binding's offset
  std::array<uint32_t, 3> maxGroups = {};
  float maxAnisotropy = 1;
};

// The clock that times passes. Timestamps of software drivers are wrong. On these drivers the layer
// reads the wall clock before each pass and after a wait for its end.
enum class Clock : uint8_t { kNone, kGpu, kWall };
const char* clockName(Clock clock);  // "none", "gpu", "wall"

struct DeviceInfo {
  std::string backend = {};  // "opengl", "vulkan", "null"
  std::string name = {};     // the driver's name for the device
  std::string driver = {};   // the driver and its version
  bool software = false;
  Clock clock = Clock::kNone;
  Capabilities capabilities = {};
};

struct PassTime {
  std::string label = {};
  double milliseconds = 0;
};

// Times of one finished frame. `wholeMilliseconds` spans from the start of the first pass to the
// end of the last pass, by the same clock as the passes.
struct FrameTimes {
  uint64_t frame = 0;  // counted from 0 for the first begin()
  std::vector<PassTime> passes = {};
  double wholeMilliseconds = 0;
};

}  // namespace grisaille::gpu
