// SPDX-License-Identifier: MIT
// The C functions of grisaille/host.h. They return error numbers and let no exception out.
#include <algorithm>
#include <array>
#include <cstring>
#include <new>
#include <type_traits>
#include <utility>

#include "backends/opengl/opengl.h"
#include "backends/vulkan/vulkan.h"
#include "core/objects/object_file.h"
#include "host/checks.h"
#include "host/effect.h"
#include "host/memory.h"

namespace grisaille::host {
namespace {

thread_local std::array<char, 1024> lastError = {};

int note(ErrorId id, std::string_view line) noexcept {
  const size_t length = std::min(line.size(), lastError.size() - 1);
  std::copy_n(line.begin(), length, lastError.begin());
  lastError[length] = '\0';
  return static_cast<int>(id);
}

template <typename Work>
int caught(Work&& work) noexcept {
  try {
    try {
      work();
      return 0;
    } catch (const Error& error) {
      return note(error.id(), error.what());
    } catch (const std::bad_alloc&) {
      return note(ErrorId::kOutOfMemory, "error E9002: out of memory; close other programs");
    } catch (const std::exception& error) {
      return note(ErrorId::kUnexpected, Error(ErrorId::kUnexpected, oneLine(error.what())).what());
    }
  } catch (...) {
    return note(ErrorId::kUnexpected, "error E9001: an unknown exception was thrown; report it");
  }
}

// Tells the log of a failed call.
template <typename Work>
int guarded(const Log& log, Work&& work) noexcept {
  const int result = caught(std::forward<Work>(work));
  if (result != 0) log.write(GRISAILLE_HOST_ERROR, lastError.data());
  return result;
}

// `of`: the device, texture or effect of the call; may be null.
template <typename Object, typename Work>
int guarded(const Object* of, Work&& work) noexcept {
  if (of == nullptr) return caught(std::forward<Work>(work));
  if constexpr (std::is_same_v<Object, grisaille_host_device>) {
    return guarded(of->log, std::forward<Work>(work));
  } else {
    return guarded(of->device.log, std::forward<Work>(work));
  }
}

// Sets `out` to null before the work, so that it stays null after an error. `of`: a log, or as in
// guarded().
template <typename Of, typename Made, typename Make>
int making(const Of& of, Made** out, Make&& make) noexcept {
  return guarded(of, [&] {
    present(out, "out") = nullptr;
    *out = make();
  });
}

// Ends the effect first: its errors go to the log, and it is destroyed nevertheless.
void endQuietly(grisaille_host_effect& effect) {
  guarded(&effect, [&] { effect.end(); });
}
void endQuietly(grisaille_host_texture&) {}

template <typename Made>
int ending(Made* made) noexcept {
  return guarded(made, [&] {
    if (made == nullptr) return;
    made->device.gpu->requireUsable();
    endQuietly(*made);
    delete made;
  });
}

// The log of a device that is about to be created; none if its description is wrong, which the
// creation then reports.
template <typename Desc>
Log logOf(const Desc* given) {
  Log log;
  caught([&] {
    const Desc desc = whole(given, "desc");
    if (desc.log != nullptr) log = Log(whole(desc.log, "log"));
  });
  return log;
}

void fill(const gpu::MemoryUse& use, grisaille_host_memory_use* out) {
  grisaille_host_memory_use to = whole(out, "out");
  to.device_bytes = use.deviceBytes;
  to.host_bytes = use.hostBytes;
  to.allocations = use.allocations;
  std::memcpy(out, &to, std::min<size_t>(to.struct_size, sizeof(to)));
}

void checkLog(const grisaille_host_log* log) {
  if (log == nullptr) return;
  const grisaille_host_log given = whole(log, "log");
  checkReserved(given.reserved, "log.reserved");
  if (given.write == nullptr) throw Error(ErrorId::kHostNull, "log.write is null");
}

// Sets functions of a device that the host implements, or none if `functions` is null.
// name: of the parameter.
template <typename Services, typename Functions>
int setFunctions(grisaille_host_device* device, Services grisaille_host_device::*services,
                 const Functions* functions, const char* name) noexcept {
  return guarded(device, [&] {
    Services& to = present(device, "device").*services;
    if (functions == nullptr) return to.set({});
    const Functions given = whole(functions, name);
    checkReserved(given.reserved, (std::string(name) + ".reserved").c_str());
    to.set(given);
  });
}

}  // namespace
}  // namespace grisaille::host

using namespace grisaille;        // NOLINT: these functions are all that this file has
using namespace grisaille::host;  // NOLINT

uint32_t grisaille_host_version(void) {
  return GRISAILLE_HOST_VERSION;
}

const char* grisaille_host_last_error(void) {
  return lastError.data();
}

int grisaille_host_device_vulkan(const grisaille_host_vulkan* vulkan, grisaille_host_device** out) {
  const Log log = logOf(vulkan);
  return making(log, out, [&] {
    const grisaille_host_vulkan given = whole(vulkan, "vulkan");
    checkFlags(given.flags, "vulkan.flags");
    checkLog(given.log);
    if (given.frames_in_flight < 1 || given.frames_in_flight > 16) {
      throw Error(ErrorId::kHostValue, "vulkan.frames_in_flight is {}, out of 1 to 16",
                  given.frames_in_flight);
    }
    checkHandle(given.instance, "vulkan.instance");
    checkHandle(given.physical_device, "vulkan.physical_device");
    checkHandle(given.device, "vulkan.device");
    std::unique_ptr<grisaille::vulkan::MemorySource> memory = memorySource(given.allocator);
    const grisaille::vulkan::HostHandles handles = {
        .instance = given.instance,
        .physicalDevice = given.physical_device,
        .device = given.device,
        .queueFamily = given.queue_family,
        .framesInFlight = given.frames_in_flight,
        .getInstanceProcAddr = given.get_instance_proc_addr,
        .pipelineCache = given.pipeline_cache,
        .callbacks = given.allocation_callbacks,
        .memory = memory.get()};
    return new grisaille_host_device(grisaille::vulkan::createHostDevice(handles),
                                     {.effectFolder = given.effect_folder,
                                      .framesInFlight = given.frames_in_flight,
                                      .flags = given.flags,
                                      .log = log,
                                      .memory = std::move(memory)});
  });
}

int grisaille_host_device_opengl(const grisaille_host_opengl* opengl, grisaille_host_device** out) {
  const Log log = logOf(opengl);
  return making(log, out, [&] {
    const grisaille_host_opengl given = whole(opengl, "opengl");
    checkFlags(given.flags, "opengl.flags");
    checkLog(given.log);
    checkEnum(given.state, 2, "opengl.state");
    if (given.frames_in_flight > 16) {
      throw Error(ErrorId::kHostValue, "opengl.frames_in_flight is {}, out of 0 to 16",
                  given.frames_in_flight);
    }
    constexpr uint32_t kUsualFrames = 3;
    const grisaille::opengl::HostSpec spec = {
        .framesInFlight = given.frames_in_flight > 0 ? given.frames_in_flight : kUsualFrames,
        .keepsState = given.state == GRISAILLE_HOST_STATE_KEPT};
    return new grisaille_host_device(grisaille::opengl::createHostDevice(spec),
                                     {.effectFolder = given.effect_folder,
                                      .framesInFlight = spec.framesInFlight,
                                      .flags = given.flags,
                                      .log = log});
  });
}

int grisaille_host_device_destroy(grisaille_host_device* device) {
  return guarded(device, [&] {
    if (device == nullptr) return;
    if (device->textures + device->effects > 0) {
      throw Error(ErrorId::kHostInUse, "{} textures and {} effects still exist", device->textures,
                  device->effects);
    }
    device->gpu->requireUsable();
    delete device;
  });
}

int grisaille_host_effects(const grisaille_host_device* device,
                           const grisaille_effect_desc* const** effects, uint32_t* count) {
  return guarded(device, [&] {
    const grisaille_host_device& of = present(device, "device");
    const grisaille_effect_desc* const*& list = present(effects, "effects");
    present(count, "count") = static_cast<uint32_t>(of.tables.size());
    list = of.tables.data();
  });
}

int grisaille_host_texture_wrap(grisaille_host_device* device,
                                const grisaille_host_texture_desc* desc,
                                grisaille_host_texture** out) {
  return making(device, out, [&] {
    return new grisaille_host_texture(present(device, "device"), whole(desc, "desc"));
  });
}

int grisaille_host_texture_destroy(grisaille_host_texture* texture) {
  return ending(texture);
}

int grisaille_host_effect_create(grisaille_host_device* device,
                                 const grisaille_host_effect_desc* desc,
                                 grisaille_host_effect** out) {
  return making(device, out, [&] {
    return new grisaille_host_effect(present(device, "device"), whole(desc, "desc"));
  });
}

int grisaille_host_effect_destroy(grisaille_host_effect* effect) {
  return ending(effect);
}

int grisaille_host_effect_set(grisaille_host_effect* effect, const char* key, double value) {
  return guarded(effect, [&] { present(effect, "effect").set(&present(key, "key"), value); });
}

int grisaille_host_effect_set_text(grisaille_host_effect* effect, const char* key,
                                   const char* text) {
  return guarded(effect, [&] {
    present(effect, "effect").set(&present(key, "key"), std::string_view(&present(text, "text")));
  });
}

int grisaille_host_effect_get(const grisaille_host_effect* effect, const char* key, double* value) {
  return guarded(effect, [&] {
    double& to = present(value, "value");
    to = present(effect, "effect").values().get(&present(key, "key"));
  });
}

int grisaille_host_effect_set_objects(grisaille_host_effect* effect, const void* objects,
                                      uint32_t object_size, uint64_t count) {
  return guarded(effect, [&] {
    const objects::Table& table = present(effect, "effect").objectTable();
    if (object_size != table.object_size) {
      throw Error(ErrorId::kHostValue, "object_size is {}, but the effect's table has {}",
                  object_size, table.object_size);
    }
    const auto* bytes = static_cast<const std::byte*>(objects);
    if (count > 0) present(bytes, "objects");
    effect->setObjects({&table, bytes, static_cast<size_t>(count)});
  });
}

int grisaille_host_effect_load_objects(grisaille_host_effect* effect, const char* path) {
  return guarded(effect, [&] {
    const objects::Table& table = present(effect, "effect").objectTable();
    effect->setObjects(objects::load(table, &present(path, "path")).view());
  });
}

int grisaille_host_device_set_pictures(grisaille_host_device* device,
                                       const grisaille_host_pictures* pictures) {
  return setFunctions(device, &grisaille_host_device::pictures, pictures, "pictures");
}

int grisaille_host_device_set_rays(grisaille_host_device* device, const grisaille_host_rays* rays) {
  return setFunctions(device, &grisaille_host_device::rays, rays, "rays");
}

int grisaille_host_device_set_depths(grisaille_host_device* device,
                                     const grisaille_host_depths* depths) {
  return setFunctions(device, &grisaille_host_device::depths, depths, "depths");
}

int grisaille_host_effect_resize(grisaille_host_effect* effect, uint32_t width, uint32_t height) {
  return guarded(effect, [&] {
    grisaille_host_effect& one = present(effect, "effect");
    one.device.gpu->requireUsable();
    one.resize(width, height);
  });
}

int grisaille_host_effect_record(grisaille_host_effect* effect, const grisaille_host_frame* frame) {
  return guarded(effect, [&] { present(effect, "effect").record(whole(frame, "frame")); });
}

int grisaille_host_effect_prepare(grisaille_host_effect* effect,
                                  const grisaille_host_prepare* how) {
  return guarded(effect, [&] {
    grisaille_host_prepare with = {};
    if (how != nullptr) with = whole(how, "how");
    present(effect, "effect").prepare(with);
  });
}

int grisaille_host_effect_dropped(grisaille_host_effect* effect) {
  return guarded(effect, [&] { present(effect, "effect").dropped(); });
}

int grisaille_host_memory_needed(grisaille_host_device* device,
                                 const grisaille_host_effect_desc* desc,
                                 const grisaille_host_prepare* how,
                                 grisaille_host_memory_use* out) {
  return guarded(device, [&] {
    const grisaille_host_device& of = present(device, "device");
    const grisaille_host_effect_desc wanted = whole(desc, "desc");
    grisaille_host_prepare with = {};
    if (how != nullptr) with = whole(how, "how");
    whole(out, "out");
    fill(memoryNeeded(of, wanted, with), out);
  });
}

int grisaille_host_device_memory(const grisaille_host_device* device,
                                 grisaille_host_memory_use* out) {
  return guarded(device, [&] { fill(present(device, "device").gpu->memory(), out); });
}

int grisaille_host_effect_memory(const grisaille_host_effect* effect,
                                 grisaille_host_memory_use* out) {
  return guarded(effect, [&] { fill(present(effect, "effect").memory(), out); });
}

int grisaille_host_effect_report(const grisaille_host_effect* effect, grisaille_host_report* out) {
  return guarded(effect, [&] {
    const effect::Report& report = present(effect, "effect").report();
    grisaille_host_report to = whole(out, "out");
    to.waiting = report.waiting;
    to.given_up = report.givenUp;
    to.coarser = report.coarser;
    std::memcpy(out, &to, std::min<size_t>(to.struct_size, sizeof(to)));
  });
}

int grisaille_host_effect_draw_at(grisaille_host_effect* effect, const grisaille_point* points,
                                  uint64_t count, grisaille_drawn* drawn) {
  return guarded(effect, [&] {
    grisaille_host_effect& one = present(effect, "effect");
    if (count == 0) return;
    const auto size = static_cast<size_t>(count);
    one.drawAt({&present(points, "points"), size}, {&present(drawn, "drawn"), size});
  });
}

int grisaille_host_effect_output(const grisaille_host_effect* effect, const char* key,
                                 grisaille_host_output* out) {
  return guarded(effect, [&] {
    const grisaille_host_effect& one = present(effect, "effect");
    grisaille_host_output to = whole(out, "out");
    uint32_t format = 0;
    const gpu::NativeTexture texture = one.output(&present(key, "key"), format);
    to.format = format;
    to.native_format = texture.format;
    to.layout = texture.layout;
    to.width = one.width;
    to.height = one.height;
    to.image = texture.name;
    to.view = texture.view;
    to.layers = one.layers;
    std::memcpy(out, &to, std::min<size_t>(to.struct_size, sizeof(to)));
  });
}
