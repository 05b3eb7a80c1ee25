// SPDX-License-Identifier: MIT
// Attachments from pictures made elsewhere, of a scene that is not here.
#pragma once

#include "core/frame/attachments.h"
#include "core/image/image.h"

namespace grisaille::frame {

// All of one size. Those without pixels are not there.
struct Pictures {
  image::Image viewDepth;   // one channel, metres, finite; 0: sky
  image::Image normal;      // three channels, world; without, those of the depth's facets
  image::Image baseColour;  // three channels, linear
};

// Throws kPictureSize, and kPictureDepth for a normal that is no number.
void checkPictures(const Pictures& pictures);

class PictureAttachments : public AttachmentSource {
 public:
  // `device` finds the facets that a depth shows. Without it, normals that no picture has are
  // missing.
  explicit PictureAttachments(gpu::Device* device = nullptr) : device_(device) {}
  ~PictureAttachments() override;
  PictureAttachments(const PictureAttachments&) = delete;
  PictureAttachments& operator=(const PictureAttachments&) = delete;

  // What the frames from now on show. Throws as checkPictures() does.
  void show(Pictures pictures);

  uint32_t width() const { return pictures_.viewDepth.width; }
  uint32_t height() const { return pictures_.viewDepth.height; }

  // Pictures end at their border.
  bool goesBeyond() const override { return false; }
  // Clip depth is 1 at most: nothing is nearer than the near plane.
  void record(gpu::Commands& commands, const scene::Camera& camera, uint32_t width, uint32_t height,
              gpu::BufferRange viewBlock, const AttachmentTargets& targets,
              std::string_view passes) override;

 private:
  void drawFacets(gpu::Commands& commands, gpu::Texture viewDepth, gpu::BufferRange viewBlock,
                  gpu::Texture to);

  gpu::Device* device_;
  gpu::GraphicsPipeline facets_;
  gpu::Sampler nearest_;
  Pictures pictures_;
};

}  // namespace grisaille::frame
