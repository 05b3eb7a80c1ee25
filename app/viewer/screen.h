// SPDX-License-Identifier: MIT
// Composes the window: the stage's picture in its rectangle, with the interface drawn over it.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <utility>

#include "app/viewer/controls.h"
#include "app/viewer/interface.h"

namespace grisaille::app::viewer {

// Parameters of Screen::draw().
struct ScreenDesc {
  glm::uvec2 pixels = glm::uvec2(0);  // of the window, over 0
  Place place;
  std::array<Side, 2> sides = {};   // without a texture: the picture stays empty
  bool keeps = false;               // without a texture: shows the last picture instead
  glm::uvec2 size = glm::uvec2(0);  // of the sides' picture, pixels
  uint32_t scale = 1;               // its pixels per texel of the sides, both ways
  uint64_t revision = 0;            // changes with the content of the sides
  bool split = false;
  float line = 0.5f;  // of the split, as a share of the picture's width
  SplitWay way = SplitWay::kLine;
  bool turned = false;                 // with kFlicker: the right side is shown, else the left
  float full = 0.25f;                  // with kDifference: as in SplitSettings
  float zoom = 1;                      // pixels of the window per pixel of the picture
  glm::vec2 centre = glm::vec2(0.5f);  // point in the middle, as a share of the picture
  float farDepth = 1;                  // metres, drawn as mid grey
  float lineWidth = 1;                 // pixels
  const InterfacePictures* pictures = nullptr;  // of the interface; null: none
};

class Screen {
 public:
  // The device must outlive this.
  explicit Screen(gpu::Device& device) : device_(device), interface_(device) {}
  ~Screen();
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  void fontChanged() { interface_.fontChanged(); }

  // Draws the picture, if it has changed, and the interface, as one frame of the device. The result
  // is valid until the next call.
  gpu::Texture draw(const ScreenDesc& desc, const ImDrawData& interfaceData);

  // The window's content of the last draw() without the interface; null before.
  gpu::Texture picture() const { return shown_ ? picture_ : gpu::Texture(); }

 private:
  // Same layout as in shaders/viewer/show.comp.
  struct ShowBlock {
    glm::ivec2 place, size;
    glm::vec2 centre;
    float zoom, line, far_depth, line_width, full;

    bool operator==(const ShowBlock&) const = default;
  };
  // Every input of the shown picture.
  struct Shown {
    ShowBlock block;
    std::array<Side, 2> sides;
    uint64_t revision;

    bool operator==(const Shown&) const = default;
  };

  Shown wanted(const ScreenDesc& desc) const;
  void prepare(gpu::Commands& commands, const ScreenDesc& desc);
  void show(gpu::Commands& commands, const Shown& wanted);
  gpu::ComputePipeline showPipeline(const std::array<Kind, 2>& kinds);

  gpu::Device& device_;
  InterfaceRenderer interface_;
  gpu::Texture picture_, window_;  // of the window's size: without and with the interface
  gpu::Texture blank_;             // 1 x 1 texel, shown without a picture
  glm::uvec2 size_ = glm::uvec2(0);
  std::map<std::array<Kind, 2>, gpu::ComputePipeline> show_;
  gpu::ComputePipeline copy_;
  gpu::Sampler nearest_;
  std::optional<Shown> shown_;
};

}  // namespace grisaille::app::viewer
