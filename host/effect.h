// SPDX-License-Identifier: MIT
// What grisaille_host_effect points to.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "core/effect/chain.h"
#include "host/device.h"

struct grisaille_host_effect {
  // Throws as grisaille_host_effect_create() has it.
  grisaille_host_effect(grisaille_host_device& of, const grisaille_host_effect_desc& desc);
  ~grisaille_host_effect();
  grisaille_host_effect(const grisaille_host_effect&) = delete;
  grisaille_host_effect& operator=(const grisaille_host_effect&) = delete;

  void resize(uint32_t width, uint32_t height);
  // The effect's one list. Throws kEffectTakesNoObjects.
  grisaille::objects::ObjectList& objects();
  grisaille::effect::Values& values() { return chain_.selection.entries()[0].values; }
  const grisaille::effect::Values& values() const { return chain_.selection.entries()[0].values; }
  void record(const grisaille_host_frame& frame);
  grisaille::gpu::NativeTexture output(std::string_view key, uint32_t& format) const;

  grisaille_host_device& device;
  uint32_t width = 0, height = 0;  // pixels

 private:
  struct Picture {
    grisaille::gpu::Texture made;   // by the effect, rows from the top; null: not wanted
    grisaille::gpu::Texture shown;  // to the host: the same, or with its rows turned over
  };

  uint32_t indexOf(std::string_view key) const;
  void drop(std::vector<Picture>& pictures);
  void makePictures(std::vector<Picture>& pictures, uint32_t ofWidth, uint32_t ofHeight);
  grisaille::host::Textures texturesOf(const grisaille_host_frame& frame, uint32_t reads) const;
  void recordInto(grisaille::gpu::Commands& commands, const grisaille::host::View& view,
                  const grisaille::host::Textures& textures, uint32_t reads);

  const uint32_t rows_;
  grisaille::effect::Chain chain_;  // of this effect alone
  uint32_t wanted_ = 0;             // outputs, by bit
  std::vector<Picture> pictures_;   // one an output
  std::vector<grisaille::gpu::Texture> made_, shown_;
  grisaille::host::Attachments attachments_;
};
