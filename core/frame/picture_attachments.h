// SPDX-License-Identifier: MIT
// Attachments from another renderer's pictures, without the scene.
#pragma once

#include "core/frame/attachments.h"
#include "core/image/image.h"

namespace grisaille::frame {

// The pictures of one frame, all of one size. A picture without pixels is missing.
struct Pictures {
  image::Image viewDepth;       // one channel, metres, finite; 0: sky
  image::Image normal;          // three channels, world; if missing: facet normals from depth
  image::Image baseColour;      // three channels, linear
  image::Image thickness = {};  // one channel, metres, finite; see GRISAILLE_THICKNESS
};

// Throws kPictureSize, kPictureDepth for a normal and kPictureThickness for a thickness that is not
// finite.
void checkPictures(const Pictures& pictures);

class PictureAttachments : public AttachmentSource {
 public:
  // `device` computes facet normals from depth. If it is null, normals come only from the picture.
  explicit PictureAttachments(gpu::Device* device = nullptr) : device_(device) {}
  ~PictureAttachments() override;
  PictureAttachments(const PictureAttachments&) = delete;
  PictureAttachments& operator=(const PictureAttachments&) = delete;

  // Sets the pictures, from the next frame on. Throws the errors of checkPictures().
  void show(Pictures pictures);

  uint32_t width() const { return pictures_.viewDepth.width; }
  uint32_t height() const { return pictures_.viewDepth.height; }

  // Pictures have no pixels beyond their border.
  bool goesBeyond() const override { return false; }
  bool hasThickness() const override { return !pictures_.thickness.pixels.empty(); }
  // Clamps clip depth to 1, the near plane.
  void record(gpu::Commands& commands, const scene::View& view, gpu::BufferRange viewBlock,
              const AttachmentTargets& targets, std::string_view passes) override;

 private:
  void drawFacets(gpu::Commands& commands, gpu::Texture viewDepth, gpu::BufferRange viewBlock,
                  gpu::Texture to);

  gpu::Device* device_;
  gpu::GraphicsPipeline facets_;
  gpu::Sampler nearest_;
  Pictures pictures_;
};

}  // namespace grisaille::frame
