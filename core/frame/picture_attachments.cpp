// SPDX-License-Identifier: MIT
#include "core/frame/picture_attachments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/color_space.hpp>
#include <glm/gtc/packing.hpp>

#include "core/base/error.h"
#include "shaders/facet_normal_frag.h"
#include "shaders/whole_picture_vert.h"

namespace grisaille::frame {
namespace {

void checkSize(const Pictures& pictures, const image::Image& other, const char* name) {
  const image::Image& depth = pictures.viewDepth;
  if (other.pixels.empty()) return;
  if (other.width == depth.width && other.height == depth.height) return;
  throw Error(ErrorId::kPictureSize, "the {} has {} x {} pixels, the depth {} x {}", name,
              other.width, other.height, depth.width, depth.height);
}

void checkFinite(const image::Image& picture, ErrorId error, const char* name) {
  const std::vector<float>& values = picture.pixels;
  const auto odd = std::ranges::find_if(values, [](float v) { return !std::isfinite(v); });
  if (odd == values.end()) return;
  const auto pixel = static_cast<size_t>(odd - values.begin()) / picture.channels;
  throw Error(error, "the {} at ({}, {}) is not finite", name, pixel % picture.width,
              pixel / picture.width);
}

template <typename Texel>
void upload(gpu::Commands& commands, gpu::Texture texture, const std::vector<Texel>& texels) {
  commands.upload(texture, 0, 0, std::as_bytes(std::span(texels)));
}

using Half4 = std::array<uint16_t, 4>;

// World normals of unit length. Normals whose length is 1 within the precision of half floats are
// not rescaled: a picture written from such a target gives the same bits again.
std::vector<Half4> normalTexels(const image::Image& normal, const image::Image& depth) {
  constexpr float kHalfPrecision = 0.002f;
  std::vector<Half4> texels(depth.pixels.size(), Half4{});
  for (size_t i = 0; i < texels.size(); ++i) {
    if (depth.pixels[i] <= 0) continue;
    glm::vec3 n(normal.pixels[3 * i], normal.pixels[3 * i + 1], normal.pixels[3 * i + 2]);
    const float length = glm::length(n);
    if (length == 0) {
      n = glm::vec3(0);
    } else if (std::abs(length - 1) > kHalfPrecision) {
      n /= length;
    }
    texels[i] = {glm::packHalf1x16(n.x), glm::packHalf1x16(n.y), glm::packHalf1x16(n.z),
                 glm::packHalf1x16(1)};
  }
  return texels;
}

std::vector<float> clipDepth(const image::Image& depth, const scene::View& view) {
  std::vector<float> clip(depth.pixels.size());
  for (size_t i = 0; i < clip.size(); ++i) {
    const float metres = depth.pixels[i];
    const double reversed = metres > 0 ? scene::clipDepthOf(view, double{metres}) : 0;
    clip[i] = static_cast<float>(std::clamp(reversed, 0.0, 1.0));
  }
  return clip;
}

std::vector<glm::u8vec4> colourTexels(const image::Image& colour, const image::Image& depth) {
  std::vector<glm::u8vec4> texels(depth.pixels.size(), glm::u8vec4(0));
  for (size_t i = 0; i < texels.size(); ++i) {
    if (depth.pixels[i] <= 0) continue;
    const glm::vec3 linear(colour.pixels[3 * i], colour.pixels[3 * i + 1],
                           colour.pixels[3 * i + 2]);
    const glm::vec3 encoded = glm::convertLinearToSRGB(glm::clamp(linear, 0.0f, 1.0f));
    texels[i] = glm::u8vec4(glm::round(encoded * 255.0f), 255);
  }
  return texels;
}

}  // namespace

void checkPictures(const Pictures& pictures) {
  checkSize(pictures, pictures.normal, "normal");
  checkSize(pictures, pictures.baseColour, "base colour");
  checkSize(pictures, pictures.thickness, "thickness");
  checkFinite(pictures.normal, ErrorId::kPictureDepth, "normal");
  checkFinite(pictures.thickness, ErrorId::kPictureThickness, "thickness");
}

PictureAttachments::~PictureAttachments() {
  if (!device_) return;
  device_->destroy(facets_);
  device_->destroy(nearest_);
}

void PictureAttachments::show(Pictures pictures) {
  checkPictures(pictures);
  pictures_ = std::move(pictures);
}

void PictureAttachments::record(gpu::Commands& commands, const scene::View& view,
                                gpu::BufferRange viewBlock, const AttachmentTargets& targets,
                                std::string_view) {
  const image::Image& depth = pictures_.viewDepth;
  const uint32_t width = view.size.x, height = view.size.y;
  if (depth.width != width || depth.height != height) {
    throw Error(ErrorId::kPictureSize, "the depth has {} x {} pixels, the frame {} x {}",
                depth.width, depth.height, width, height);
  }
  if (targets.baseColour && pictures_.baseColour.pixels.empty()) {
    throw Error(ErrorId::kPictureMissing, "base colours are needed, but no picture has any");
  }
  const bool given = !pictures_.normal.pixels.empty();
  const std::array facets = {targets.facetNormal, given ? gpu::Texture() : targets.normal};
  gpu::Texture viewDepth = targets.viewDepth;
  if (!viewDepth && (facets[0] || facets[1])) {
    viewDepth = commands.transient({.label = "facets' depth",
                                    .format = gpu::Format::kR32Float,
                                    .width = width,
                                    .height = height,
                                    .usage = gpu::TextureUsage::kSampled});
  }
  commands.beginPass("pictures/upload");
  upload(commands, targets.depth, clipDepth(depth, view));
  if (viewDepth) upload(commands, viewDepth, depth.pixels);
  for (const gpu::Texture to : {targets.backDepth, targets.nextDepth}) {
    // Pictures have neither: 0 stands for no surface.
    if (to) upload(commands, to, std::vector<float>(depth.pixels.size(), 0.0f));
  }
  if (targets.baseColour) {
    upload(commands, targets.baseColour, colourTexels(pictures_.baseColour, depth));
  }
  if (targets.thickness) upload(commands, targets.thickness, pictures_.thickness.pixels);
  if (targets.normal && given) {
    upload(commands, targets.normal, normalTexels(pictures_.normal, depth));
  }
  commands.endPass();
  for (const gpu::Texture to : facets) {
    if (to) drawFacets(commands, viewDepth, viewBlock, to);
  }
}

void PictureAttachments::drawFacets(gpu::Commands& commands, gpu::Texture viewDepth,
                                    gpu::BufferRange viewBlock, gpu::Texture to) {
  if (!device_) throw Error(ErrorId::kPictureMissing, "normals are needed, but no picture has any");
  if (!facets_) {
    constexpr gpu::Format kNormals[] = {gpu::Format::kRgba16Float};
    nearest_ = device_->createSampler({.label = "nearest facet"});
    facets_ = device_->createGraphicsPipeline({.label = "facet normals",
                                               .vertex = &grisaille_shader_whole_picture_vert,
                                               .fragment = &grisaille_shader_facet_normal_frag,
                                               .colorFormats = kNormals});
  }
  const std::array bindings = {gpu::uniformBinding(0, viewBlock),
                               gpu::textureBinding(0, {.texture = viewDepth}, nearest_)};
  const gpu::ColorTarget colors[] = {{.view = {.texture = to}, .load = gpu::Load::kDiscard}};
  const gpu::Draw draws[] = {{.pipeline = facets_, .bindings = bindings, .count = 3}};
  commands.beginPass("pictures/facet normals");
  commands.render({.colors = colors, .draws = draws});
  commands.endPass();
}

}  // namespace grisaille::frame
