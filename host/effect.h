// SPDX-License-Identifier: MIT
// The object behind grisaille_host_effect.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/effect/chain.h"
#include "host/device.h"

struct grisaille_host_effect {
  // Throws the errors of grisaille_host_effect_create().
  grisaille_host_effect(grisaille_host_device& of, const grisaille_host_effect_desc& desc);
  ~grisaille_host_effect();
  grisaille_host_effect(const grisaille_host_effect&) = delete;
  grisaille_host_effect& operator=(const grisaille_host_effect&) = delete;

  void resize(uint32_t width, uint32_t height);
  // The effect's list of objects. Throws kEffectTakesNoObjects.
  grisaille::objects::ObjectList& objects();
  grisaille::effect::Values& values() { return chain_.selection.entries()[0].values; }
  const grisaille::effect::Values& values() const { return chain_.selection.entries()[0].values; }
  void record(const grisaille_host_frame& frame);
  // Creates the pipelines that recordings with these inputs need.
  void prepare(const grisaille_host_prepare& how);
  // Forgets all that recordings have written: for a recording that the host has dropped.
  void dropped();
  // Throws the errors of grisaille_host_effect_draw_at().
  void drawAt(std::span<const grisaille_point> points, std::span<grisaille_drawn> drawn);
  const grisaille::effect::Report& report() const { return report_; }
  grisaille::gpu::NativeTexture output(std::string_view key, uint32_t& format) const;

  grisaille_host_device& device;
  uint32_t width = 0, height = 0;  // pixels

 private:
  struct Picture {
    grisaille::gpu::Texture made;   // the effect writes it, top row first; null: not wanted
    grisaille::gpu::Texture shown;  // the host reads it: the same, or with flipped rows
  };

  uint32_t indexOf(std::string_view key) const;
  void drop(std::vector<Picture>& pictures);
  void makePictures(std::vector<Picture>& pictures, uint32_t ofWidth, uint32_t ofHeight);
  grisaille::host::Textures texturesOf(const grisaille_host_frame& frame, uint32_t reads) const;
  void findNamed(const grisaille_host_frame& frame, grisaille::host::Textures& textures) const;
  void recordInto(grisaille::gpu::Commands& commands, const grisaille::host::View& view,
                  const grisaille::host::MotionBlock& motion,
                  const grisaille::host::Textures& textures, uint32_t reads, double patience);

  void release(std::vector<grisaille::gpu::ComputePipeline>& pipelines);

  const uint32_t rows_;
  grisaille::effect::Chain chain_;  // holds only this effect
  uint32_t wanted_ = 0;             // wanted outputs, by bit
  grisaille::effect::Report report_;
  std::vector<Picture> pictures_;  // one per output
  std::vector<grisaille::gpu::Texture> made_, shown_;
  grisaille::host::Attachments attachments_;
  std::optional<grisaille::scene::View> before_;           // of the last recording, at this size
  std::vector<grisaille::gpu::ComputePipeline> prepared_;  // kept until the next prepare()
};
