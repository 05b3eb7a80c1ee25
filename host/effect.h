// SPDX-License-Identifier: MIT
// The object behind grisaille_host_effect.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/effect/chain.h"
#include "host/device.h"
#include "host/pool.h"
#include "host/wanted.h"

struct grisaille_host_effect {
  // Throws the errors of grisaille_host_effect_create().
  grisaille_host_effect(grisaille_host_device& of, const grisaille_host_effect_desc& desc);
  ~grisaille_host_effect();
  grisaille_host_effect(const grisaille_host_effect&) = delete;
  grisaille_host_effect& operator=(const grisaille_host_effect&) = delete;

  void resize(uint32_t width, uint32_t height);
  // The table of the effect's objects. Throws kEffectTakesNoObjects.
  const grisaille::objects::Table& objectTable();
  void setObjects(const grisaille::objects::View& objects);
  const grisaille::effect::Values& values() const { return valuesOf(chains_[0]); }
  // `value`: a number or a text, as Values::set() takes it.
  template <typename Value>
  void set(std::string_view key, Value value) {
    for (grisaille::effect::Chain& chain : chains_) {
      chain.selection.entries()[0].values.set(key, value);
    }
  }
  void record(const grisaille_host_frame& frame);
  // Creates the pipelines that recordings with these inputs need.
  void prepare(const grisaille_host_prepare& how);
  // Forgets all that recordings have written: for a recording that the host has dropped.
  void dropped();
  // Throws the errors of grisaille_host_effect_draw_at().
  void drawAt(std::span<const grisaille_point> points, std::span<grisaille_drawn> drawn);
  const grisaille::effect::Report& report() const { return report_; }
  grisaille::gpu::NativeTexture output(std::string_view key, uint32_t& format) const;
  grisaille::gpu::MemoryUse memory() const;

  // Ends the effect's instances. Throws kEffectRecord if the effect throws.
  void end();

  grisaille_host_device& device;
  const uint32_t layers;           // views, at least 1
  uint32_t width = 0, height = 0;  // pixels

 private:
  using Pictures = std::vector<grisaille::gpu::Texture>;  // one per output; null: not wanted

  static const grisaille::effect::Values& valuesOf(const grisaille::effect::Chain& chain) {
    return chain.selection.entries()[0].values;
  }
  void prepareCopies();
  void drop(Pictures& pictures);
  Pictures makePictures(uint32_t ofWidth, uint32_t ofHeight);
  // Whether the outputs are copies of what the effect writes: with another order of rows, at a
  // place, or in a layer.
  bool copies(const grisaille_host_rectangle& place) const;
  grisaille::host::Textures texturesOf(const grisaille_host_frame& frame, uint32_t reads) const;
  void findNamed(const grisaille_host_frame& frame, grisaille::host::Textures& textures) const;
  struct Recording;
  void recordLayer(const Recording& recording, uint32_t layer);

  void release(std::vector<grisaille::gpu::ComputePipeline>& pipelines);

  const uint32_t rows_;
  const std::string label_;  // of its recordings, for debuggers
  grisaille::host::Pool pool_;
  grisaille::host::PooledCommands commands_;
  // One per layer; each holds only this effect, with the same values and objects.
  std::vector<grisaille::effect::Chain> chains_;
  uint32_t wanted_ = 0;  // wanted outputs, by bit
  grisaille::effect::Report report_;
  Pictures pictures_;                           // which the host reads
  Pictures made_;                               // which the effect writes, in a recording
  std::vector<grisaille::gpu::Texture> shown_;  // those of pictures_ that are wanted
  grisaille::host::Attachments attachments_;
  // Of the last recording, one per layer; empty: none.
  std::vector<grisaille::scene::View> before_;
  std::vector<grisaille::host::View> views_;               // of a recording, one per layer
  uint64_t uploaded_ = 0;                                  // bytes, of the largest recording
  std::vector<grisaille::gpu::ComputePipeline> prepared_;  // kept until the next prepare()
};
