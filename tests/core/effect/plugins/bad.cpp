// SPDX-License-Identifier: MIT
// Effects that fail or break the contract while they run. Each key names the fault.
#include "grisaille/effect.hpp"
#include "shaders/copy.h"

namespace {

namespace plugin = grisaille::plugin;

constexpr grisaille_output_desc kOutputs[] = {
    plugin::output({.key = "out", .format = GRISAILLE_FORMAT_R32F, .tooltip = "Never written"})};

template <typename Class>
constexpr grisaille_effect_desc named(const char* key) {
  return plugin::effect<Class>({.key = key,
                                .label = "Bad",
                                .version = "0.0.1",
                                .tooltip = "Breaks the contract",
                                .params = {},
                                .outputs = kOutputs});
}

struct Reads {
  static uint32_t reads(plugin::Values, uint32_t) noexcept {
    return GRISAILLE_READS(GRISAILLE_VIEW_DEPTH);
  }
};

struct ThrowsInCreate : Reads {
  explicit ThrowsInCreate(plugin::Host host) : kept(host.buffer("kept", 16)) {
    throw plugin::Failure("no luck in create");
  }
  void record(const plugin::Frame&) {}
  plugin::Buffer kept;
};

// The layer refuses the texture; the effect adds no message.
struct RefusedInCreate : Reads {
  explicit RefusedInCreate(plugin::Host host) { host.texture({.label = "nothing", .width = 0}); }
  void record(const plugin::Frame&) {}
};

struct ThrowsInRecord : Reads {
  explicit ThrowsInRecord(plugin::Host) {}
  void record(const plugin::Frame& frame) {
    frame.pass("half", [] { throw 42; });
  }
};

// Fails in even frames only.
struct FailsAtTimes : Reads {
  explicit FailsAtTimes(plugin::Host) {}
  void record(const plugin::Frame& frame) {
    if (frame.index() % 2 == 0) throw plugin::Failure("an even frame");
  }
};

// The layer refuses a dispatch without bindings.
struct ForgetsBindings : Reads {
  explicit ForgetsBindings(plugin::Host host)
      : pipeline(host.computePipeline("forgets", grisaille_shader_copy)) {}
  void record(const plugin::Frame& frame) {
    frame.pass("forgets", [&] { frame.dispatch(pipeline, {}, 1, 1); });
  }
  plugin::Pipeline pipeline;
};

struct DispatchesOutside : ForgetsBindings {
  using ForgetsBindings::ForgetsBindings;
  void record(const plugin::Frame& frame) { frame.dispatch(pipeline, {}, 1, 1); }
};

struct NestsPasses : Reads {
  explicit NestsPasses(plugin::Host) {}
  void record(const plugin::Frame& frame) {
    frame.pass("outer", [&] { frame.pass("inner", [] {}); });
  }
};

struct WritesAttachment : Reads {
  explicit WritesAttachment(plugin::Host) {}
  void record(const plugin::Frame& frame) {
    const std::vector<float> texels(size_t{frame.width()} * frame.height());
    frame.uploadTexture(frame.attachment(GRISAILLE_VIEW_DEPTH), texels);
  }
};

// Faults that the C++ wrapper prevents: these effects implement the C functions directly.
grisaille_result makeNothing(const grisaille_host*, void** out) {
  *out = nullptr;
  return GRISAILLE_OK;
}
grisaille_result saysNothing(const grisaille_host*, void**) {
  return GRISAILLE_FAILED;
}
void dropNothing(void*) {}

grisaille_result leavesPassOpen(void*, const grisaille_frame* frame) {
  return frame->begin_pass(frame, "endless");
}
grisaille_result endsNoPass(void*, const grisaille_frame* frame) {
  return frame->end_pass(frame);
}
grisaille_result wrongSize(void*, const grisaille_frame* frame) {
  grisaille_texture_desc desc = plugin::textureDesc({.label = "t", .width = 1, .height = 1});
  desc.struct_size += 8;
  grisaille_texture out = {0};
  return frame->transient(frame, &desc, &out);
}
grisaille_result zeroSize(void*, const grisaille_frame* frame) {
  grisaille_dispatch work = {};
  return frame->dispatch(frame, &work);
}
grisaille_result nullData(void*, const grisaille_frame* frame) {
  grisaille_range range = {};
  return frame->uniform(frame, nullptr, 16, &range);
}
// A C++ effect keeps the host in its instance.
const grisaille_host* keptHost = nullptr;
grisaille_result keepHost(const grisaille_host* host, void** out) {
  keptHost = host;
  *out = nullptr;
  return GRISAILLE_OK;
}
grisaille_result destroysForeign(void*, const grisaille_frame* frame) {
  keptHost->destroy_texture(keptHost, frame->attachments[GRISAILLE_VIEW_DEPTH]);
  return GRISAILLE_OK;
}
grisaille_result usesDestroyed(void*, const grisaille_frame* frame) {
  const grisaille_buffer_desc desc = {sizeof desc, 0, 16, "short-lived"};
  grisaille_buffer buffer = {0};
  if (keptHost->create_buffer(keptHost, &desc, &buffer) != GRISAILLE_OK) return GRISAILLE_FAILED;
  keptHost->destroy_buffer(keptHost, buffer);
  const char data[16] = {};
  return frame->upload_buffer(frame, buffer, 0, data, sizeof data);
}

constexpr grisaille_effect_desc raw(const char* key,
                                    grisaille_result (*create)(const grisaille_host*, void**),
                                    grisaille_result (*record)(void*, const grisaille_frame*)) {
  grisaille_effect_desc desc = named<NestsPasses>(key);
  desc.create = create;
  desc.record = record;
  desc.destroy = dropNothing;
  return desc;
}

constexpr auto k0 = named<ThrowsInCreate>("throws_in_create");
constexpr auto k1 = named<RefusedInCreate>("refused_in_create");
constexpr auto k2 = named<ThrowsInRecord>("throws_in_record");
constexpr auto k3 = named<FailsAtTimes>("fails_at_times");
constexpr auto k4 = named<ForgetsBindings>("forgets_bindings");
constexpr auto k5 = named<DispatchesOutside>("dispatches_outside");
constexpr auto k6 = named<NestsPasses>("nests_passes");
constexpr auto k7 = named<WritesAttachment>("writes_attachment");
constexpr auto k8 = raw("says_nothing", saysNothing, endsNoPass);
constexpr auto k9 = raw("leaves_pass_open", makeNothing, leavesPassOpen);
constexpr auto k10 = raw("ends_no_pass", makeNothing, endsNoPass);
constexpr auto k11 = raw("wrong_size", makeNothing, wrongSize);
constexpr auto k12 = raw("zero_size", makeNothing, zeroSize);
constexpr auto k13 = raw("null_data", makeNothing, nullData);
constexpr auto k14 = raw("destroys_foreign", keepHost, destroysForeign);
constexpr auto k15 = raw("uses_destroyed", keepHost, usesDestroyed);

}  // namespace

GRISAILLE_EXPORT_PLUGIN(&k0, &k1, &k2, &k3, &k4, &k5, &k6, &k7, &k8, &k9, &k10, &k11, &k12, &k13,
                        &k14, &k15);
