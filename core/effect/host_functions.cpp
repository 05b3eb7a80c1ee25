// SPDX-License-Identifier: MIT
// The C functions of grisaille_host and grisaille_frame.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "core/effect/host_services.h"

namespace grisaille::effect {
namespace {

// A call that breaks the contract of grisaille/effect.h.
class Misuse : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

template <typename... Args>
[[noreturn]] void misuse(fmt::format_string<Args...> what, Args&&... args) {
  throw Misuse(fmt::format(what, std::forward<Args>(args)...));
}

// These structs have the same size in all versions: any other size is wrong.
template <typename Desc>
const Desc& checked(const Desc* desc) {
  if (desc == nullptr) misuse("its description is null");
  if (desc->struct_size != sizeof(Desc)) {
    misuse("its struct_size is {}, not {}", desc->struct_size, sizeof(Desc));
  }
  return *desc;
}

template <typename T>
std::span<T> array(T* data, uint64_t count, const char* name) {
  if (data == nullptr && count > 0) misuse("{} is null", name);
  return {data, static_cast<size_t>(count)};
}

std::span<const std::byte> bytesOf(const void* data, uint64_t bytes) {
  if (data == nullptr) misuse("its data is null");
  return {static_cast<const std::byte*>(data), static_cast<size_t>(bytes)};
}

template <typename T>
T& present(T* out) {
  if (out == nullptr) misuse("the pointer for its result is null");
  return *out;
}

double lengthOf(const float (&v)[3]) {
  return std::hypot(double{v[0]}, double{v[1]}, double{v[2]});
}

void checkRay(uint64_t index, const grisaille_ray& ray) {
  if (!std::ranges::all_of(ray.origin, [](double x) { return std::isfinite(x); })) {
    misuse("the origin of ray {} is not finite", index);
  }
  const double length = lengthOf(ray.direction);
  if (!(std::abs(length - 1) <= 1e-3)) {
    misuse("the direction of ray {} is {} long, not 1", index, length);
  }
  if (!(ray.reach > 0)) misuse("the reach of ray {} is {}, not over 0", index, ray.reach);
}

void checkDepthView(const grisaille_depth_view& view) {
  if (!std::ranges::all_of(view.origin, [](double x) { return std::isfinite(x); })) {
    misuse("the view's origin is not finite");
  }
  if (!(std::abs(lengthOf(view.direction) - 1) <= 1e-3)) {
    misuse("the view's direction is {} long, not 1", lengthOf(view.direction));
  }
  if (!(std::abs(lengthOf(view.up) - 1) <= 1e-3)) {
    misuse("the view's up is {} long, not 1", lengthOf(view.up));
  }
  const double leans =
      std::inner_product(std::begin(view.up), std::end(view.up), std::begin(view.direction), 0.0);
  if (!(std::abs(leans) <= 1e-3)) misuse("the view's up is not normal to its direction");
  if (!(view.slope > 0) || !std::isfinite(view.slope)) {
    misuse("the view's slope is {}, not over 0 and finite", view.slope);
  }
  if (view.size < 1 || view.size > 4096) {
    misuse("the view's size is {}, not 1 to 4096", view.size);
  }
}

}  // namespace

// The functions in the tables. They return a result and let no exception out.
struct HostFunctions {
  template <typename Table, typename Work>
  static grisaille_result serve(const Table* self, const char* service, Work&& work) noexcept {
    HostServices& services = *static_cast<HostServices*>(self->context);
    try {
      try {
        if (!services.inside_) misuse("it is called outside the effect's functions");
        work(services);
        return GRISAILLE_OK;
      } catch (const Error& error) {
        services.noteDeviceFault(error.id());
        const int number = static_cast<int>(error.id());
        note(services, fmt::format("{}: E{}: {}", service, number, error.detail()));
      } catch (const std::exception& error) {
        note(services, fmt::format("{}: {}", service, error.what()));
      }
    } catch (...) {
    }  // out of memory for the message: fail without it
    return GRISAILLE_FAILED;
  }

  template <typename Work>
  static grisaille_result record(const grisaille_frame* self, const char* service, Work&& work) {
    return serve(self, service, [&](HostServices& services) {
      if (services.commands_ == nullptr) misuse("it is called outside record()");
      work(services);
    });
  }

  static void note(HostServices& services, std::string words) {
    if (services.refused_.empty()) services.refused_ = std::move(words);
  }

  static void fail(const grisaille_host* self, const char* why) {
    serve(self, "fail", [&](HostServices& s) { s.ownWords_ = why != nullptr ? oneLine(why) : ""; });
  }

  static grisaille_result createPipeline(const grisaille_host* self,
                                         const grisaille_pipeline_desc* desc,
                                         grisaille_pipeline* out) {
    return serve(self, "create_pipeline", [&](HostServices& s) {
      const grisaille_pipeline_desc& d = checked(desc);
      if (checked(d.shader).stage != GRISAILLE_STAGE_COMPUTE) misuse("it is not a compute shader");
      std::vector<gpu::Specialization> constants;
      for (const grisaille_constant& c : array(d.constants, d.constant_count, "constants")) {
        constants.push_back({c.id, c.bits});
      }
      const std::string& label = s.labelled(d.label);
      const gpu::ComputePipelineDesc wanted = {
          .label = label, .shader = d.shader, .constants = constants};
      give(s.pipelines_.own, present(out), [&] { return s.device_.createComputePipeline(wanted); });
    });
  }

  static grisaille_result createTexture(const grisaille_host* self,
                                        const grisaille_texture_desc* desc,
                                        grisaille_texture* out) {
    return serve(self, "create_texture", [&](HostServices& s) {
      gpu::TextureDesc wanted = textureDesc(checked(desc));
      const std::string& label = s.labelled(desc->label);
      wanted.label = label;
      give(s.textures_.own, present(out), [&] { return s.device_.createTexture(wanted); });
    });
  }

  static grisaille_result createBuffer(const grisaille_host* self,
                                       const grisaille_buffer_desc* desc, grisaille_buffer* out) {
    return serve(self, "create_buffer", [&](HostServices& s) {
      const grisaille_buffer_desc& d = checked(desc);
      if (d.reserved != 0) misuse("its reserved field is {}, not 0", d.reserved);
      const std::string& label = s.labelled(d.label);
      const gpu::BufferDesc wanted = {
          .label = label, .size = d.bytes, .usage = gpu::BufferUsage::kStorage};
      give(s.buffers_.own, present(out), [&] { return s.device_.createBuffer(wanted); });
    });
  }

  static grisaille_result createSampler(const grisaille_host* self,
                                        const grisaille_sampler_desc* desc,
                                        grisaille_sampler* out) {
    return serve(self, "create_sampler", [&](HostServices& s) {
      const grisaille_sampler_desc& d = checked(desc);
      const auto filter = [](uint32_t linear) {
        return linear != 0 ? gpu::Filter::kLinear : gpu::Filter::kNearest;
      };
      const auto address = d.repeat != 0 ? gpu::Address::kRepeat : gpu::Address::kClamp;
      const std::string& label = s.labelled(d.label);
      const gpu::SamplerDesc wanted = {.label = label,
                                       .filter = filter(d.linear),
                                       .mipFilter = filter(d.linear_mip),
                                       .addressU = address,
                                       .addressV = address};
      give(s.samplers_.own, present(out), [&] { return s.device_.createSampler(wanted); });
    });
  }

  // Creates a resource and stores its id in `own` and `out`.
  template <typename Id, typename Make>
  static void give(std::vector<uint32_t>& own, Id& out, Make&& make) {
    own.push_back(0);  // nothing may throw once the resource exists
    try {
      out.id = make().value;
    } catch (...) {
      own.pop_back();
      throw;
    }
    own.back() = out.id;
  }

  // Linear search: the lists are short.
  static void enter(std::vector<uint32_t>& list, uint32_t id) {
    if (!holds(list, id)) list.push_back(id);
  }
  static bool holds(const std::vector<uint32_t>& list, uint32_t id) {
    return std::ranges::find(list, id) != list.end();
  }

  static void destroyPipeline(const grisaille_host* self, grisaille_pipeline pipeline) {
    destroy(self, &HostServices::pipelines_, pipeline.id, "destroy_pipeline");
  }
  static void destroyTexture(const grisaille_host* self, grisaille_texture texture) {
    destroy(self, &HostServices::textures_, texture.id, "destroy_texture");
  }
  static void destroyBuffer(const grisaille_host* self, grisaille_buffer buffer) {
    destroy(self, &HostServices::buffers_, buffer.id, "destroy_buffer");
  }
  static void destroySampler(const grisaille_host* self, grisaille_sampler sampler) {
    destroy(self, &HostServices::samplers_, sampler.id, "destroy_sampler");
  }

  template <typename Kind>
  static void destroy(const grisaille_host* self, Kind HostServices::*kind, uint32_t id,
                      const char* service) {
    if (id == 0) return;
    serve(self, service, [&](HostServices& s) {
      using Handle = typename decltype((s.*kind).buried)::value_type;
      if (std::erase((s.*kind).own, id) == 0) {
        if (s.misuse_.empty()) s.misuse_ = fmt::format("{}: it does not own {:#x}", service, id);
      } else if (s.commands_ != nullptr) {
        (s.*kind).buried.push_back({id});
      } else {
        s.device_.destroy(Handle{id});
      }
    });
  }

  static grisaille_result castRays(const grisaille_host* self, const grisaille_ray* rays,
                                   uint64_t count, grisaille_hit* hits) {
    bool offered = true;
    const grisaille_result result = serve(self, "cast_rays", [&](HostServices& s) {
      if (!s.casts_) misuse("it is called outside record() and draw_at()");
      offered = s.offered_.rays != nullptr;
      if (!offered) return;
      const auto given = array(rays, count, "rays");
      const auto answers = array(hits, count, "hits");
      for (size_t i = 0; i < given.size(); ++i) checkRay(i, given[i]);
      s.offered_.rays->cast(given, answers);
    });
    return offered ? result : GRISAILLE_UNSUPPORTED;
  }

  static grisaille_result drawDepth(const grisaille_host* self, const grisaille_depth_view* view,
                                    float* depth) {
    bool offered = true;
    const grisaille_result result = serve(self, "draw_depth", [&](HostServices& s) {
      if (s.commands_ == nullptr) misuse("it is called outside record()");
      offered = s.offered_.depths != nullptr;
      if (!offered) return;
      if (view == nullptr) misuse("its view is null");
      checkDepthView(*view);
      s.offered_.depths->draw(*view, array(depth, uint64_t{view->size} * view->size, "depth"));
    });
    return offered ? result : GRISAILLE_UNSUPPORTED;
  }

  static grisaille_result readPicture(const grisaille_host* self, const char* path,
                                      grisaille_picture* out) {
    bool offered = true;
    const grisaille_result result = serve(self, "read_picture", [&](HostServices& s) {
      if (s.commands_ == nullptr) misuse("it is called outside record()");
      if (path == nullptr) misuse("its path is null");
      checked(out);
      offered = s.offered_.pictures != nullptr;
      if (offered) s.offered_.pictures->read(path, *out);
    });
    return offered ? result : GRISAILLE_UNSUPPORTED;
  }

  static grisaille_result beginPass(const grisaille_frame* self, const char* label) {
    return record(self, "begin_pass", [&](HostServices& s) {
      if (label == nullptr || *label == '\0') misuse("its label is empty");
      if (s.passOpen_) throw Error(ErrorId::kPassNesting, "pass {} begins inside another", label);
      s.commands_->beginPass(s.labelled(label));
      s.passOpen_ = true;
    });
  }

  static grisaille_result endPass(const grisaille_frame* self) {
    return record(self, "end_pass", [&](HostServices& s) {
      if (!s.passOpen_) throw Error(ErrorId::kPassNesting, "{} ends no pass", s.key_);
      s.passOpen_ = false;
      s.commands_->endPass();
    });
  }

  static grisaille_result dispatch(const grisaille_frame* self, const grisaille_dispatch* work) {
    return record(self, "dispatch", [&](HostServices& s) {
      const grisaille_dispatch& d = checked(work);
      if (!s.passOpen_) throw Error(ErrorId::kPassMissing, "{} dispatches outside a pass", s.key_);
      if (!holds(s.pipelines_.own, d.pipeline.id)) {
        misuse("pipeline {:#x} is not this effect's", d.pipeline.id);
      }
      s.bindings_.clear();
      for (const grisaille_binding& b : array(d.bindings, d.binding_count, "bindings")) {
        s.bindings_.push_back(bindingOf(s, b));
      }
      s.commands_->dispatch({.pipeline = {d.pipeline.id},
                             .bindings = s.bindings_,
                             .groups = {d.groups[0], d.groups[1], d.groups[2]}});
    });
  }

  static grisaille_result uniform(const grisaille_frame* self, const void* data, uint32_t bytes,
                                  grisaille_range* out) {
    return record(self, "uniform", [&](HostServices& s) {
      if (bytes == 0 || bytes > 65536) {
        throw Error(ErrorId::kUniformSize, "a uniform block has {} bytes", bytes);
      }
      grisaille_range& place = present(out);
      const gpu::BufferRange range = s.commands_->uniform(bytesOf(data, bytes));
      enter(s.uniforms_, range.buffer.value);
      place = {{range.buffer.value}, 0, range.offset, range.size};
    });
  }

  static grisaille_result transient(const grisaille_frame* self, const grisaille_texture_desc* desc,
                                    grisaille_texture* out) {
    return record(self, "transient", [&](HostServices& s) {
      gpu::TextureDesc wanted = textureDesc(checked(desc));
      const std::string& label = s.labelled(desc->label);
      wanted.label = label;
      grisaille_texture& place = present(out);
      place.id = s.commands_->transient(wanted).value;
      enter(s.writable_, place.id);
    });
  }

  static grisaille_result uploadBuffer(const grisaille_frame* self, grisaille_buffer buffer,
                                       uint64_t offset, const void* data, uint64_t bytes) {
    return record(self, "upload_buffer", [&](HostServices& s) {
      if (!holds(s.buffers_.own, buffer.id)) misuse("{:#x} is not this effect's", buffer.id);
      s.commands_->upload(gpu::Buffer{buffer.id}, offset, bytesOf(data, bytes));
    });
  }

  static grisaille_result uploadTexture(const grisaille_frame* self, grisaille_texture texture,
                                        uint32_t mip, uint32_t layer, const void* data,
                                        uint64_t bytes) {
    return record(self, "upload_texture", [&](HostServices& s) {
      s.commands_->upload(textureOf(s, texture.id, true), mip, layer, bytesOf(data, bytes));
    });
  }

  static grisaille_result waiting(const grisaille_frame* self, uint64_t count) {
    return record(self, "waiting", [&](HostServices& s) { s.report_.waiting = count; });
  }

  static grisaille_result givenUp(const grisaille_frame* self, uint64_t count) {
    return record(self, "given_up", [&](HostServices& s) { s.report_.givenUp = count; });
  }

  static grisaille_result coarser(const grisaille_frame* self, uint64_t count) {
    return record(self, "coarser", [&](HostServices& s) { s.report_.coarser = count; });
  }

  // Conversions. They throw Misuse for a resource that the effect may not use.
  static gpu::TextureDesc textureDesc(const grisaille_texture_desc& desc) {
    const gpu::Format format = formatOf(desc.format);
    if (format == gpu::Format::kNone) misuse("format {} is not a grisaille_format", desc.format);
    constexpr uint32_t kUsages = GRISAILLE_TEXTURE_SAMPLED | GRISAILLE_TEXTURE_STORAGE;
    if ((desc.usage & ~kUsages) != 0) misuse("usage {:#x} has unknown bits", desc.usage);
    gpu::TextureUsage usage = gpu::TextureUsage::kNone;
    if ((desc.usage & GRISAILLE_TEXTURE_SAMPLED) != 0) usage = usage | gpu::TextureUsage::kSampled;
    if ((desc.usage & GRISAILLE_TEXTURE_STORAGE) != 0) usage = usage | gpu::TextureUsage::kStorage;
    return {.label = {},
            .format = format,
            .width = desc.width,
            .height = desc.height,
            .mips = std::max(desc.mips, 1u),
            .layers = std::max(desc.layers, 1u),
            .usage = usage};
  }

  static gpu::BufferRange rangeOf(const HostServices& s, const grisaille_range& range) {
    const uint32_t id = range.buffer.id;
    if (id == 0 || (!holds(s.buffers_.own, id) && !holds(s.uniforms_, id))) {
      misuse("buffer {:#x} is not this effect's", id);
    }
    if (range.reserved != 0) misuse("a range's reserved field is {}, not 0", range.reserved);
    return {{id}, range.offset, range.size};
  }

  static gpu::Texture textureOf(const HostServices& s, uint32_t id, bool written) {
    const bool mine = holds(s.textures_.own, id) || holds(s.writable_, id);
    const auto among = [&](const std::vector<grisaille_texture>& textures) {
      return std::ranges::any_of(textures, [&](auto a) { return a.id == id; });
    };
    const bool given = among(s.attachments_) || among(s.inputs_);
    if (id == 0 || (!mine && !given)) misuse("texture {:#x} is not this effect's", id);
    if (written && !mine) misuse("texture {:#x} is a read-only attachment or input", id);
    return {id};
  }

  static gpu::Binding bindingOf(const HostServices& s, const grisaille_binding& b) {
    switch (b.slot_class) {
      case GRISAILLE_SLOT_UNIFORM:
        return gpu::uniformBinding(b.slot, rangeOf(s, b.range));
      case GRISAILLE_SLOT_STORAGE:
        return gpu::storageBinding(b.slot, rangeOf(s, b.range));
      case GRISAILLE_SLOT_TEXTURE: {
        if (!holds(s.samplers_.own, b.sampler.id)) {
          misuse("sampler {:#x} is not this effect's", b.sampler.id);
        }
        const gpu::TextureView view = {
            .texture = textureOf(s, b.texture.id, false), .mip = b.mip, .mipCount = b.mip_count};
        return gpu::textureBinding(b.slot, view, {b.sampler.id});
      }
      case GRISAILLE_SLOT_IMAGE:
        return gpu::imageBinding(b.slot, textureOf(s, b.texture.id, true), b.mip);
      default:
        misuse("slot_class {} is not a grisaille_slot_class", b.slot_class);
    }
  }
};

grisaille_host hostTable(HostServices* self) {
  return {.struct_size = sizeof(grisaille_host),
          .abi_minor = GRISAILLE_ABI_MINOR,
          .context = self,
          .fail = HostFunctions::fail,
          .create_pipeline = HostFunctions::createPipeline,
          .create_texture = HostFunctions::createTexture,
          .create_buffer = HostFunctions::createBuffer,
          .create_sampler = HostFunctions::createSampler,
          .destroy_pipeline = HostFunctions::destroyPipeline,
          .destroy_texture = HostFunctions::destroyTexture,
          .destroy_buffer = HostFunctions::destroyBuffer,
          .destroy_sampler = HostFunctions::destroySampler,
          .cast_rays = HostFunctions::castRays,
          .draw_depth = HostFunctions::drawDepth,
          .read_picture = HostFunctions::readPicture};
}

grisaille_frame frameTable(HostServices* self) {
  return {.struct_size = sizeof(grisaille_frame),
          .width = 0,
          .height = 0,
          .wanted = 0,
          .index = 0,
          .context = self,
          .values = nullptr,
          .view = nullptr,
          .view_block = {},
          .attachments = nullptr,
          .outputs = nullptr,
          .begin_pass = HostFunctions::beginPass,
          .end_pass = HostFunctions::endPass,
          .dispatch = HostFunctions::dispatch,
          .uniform = HostFunctions::uniform,
          .transient = HostFunctions::transient,
          .upload_buffer = HostFunctions::uploadBuffer,
          .upload_texture = HostFunctions::uploadTexture,
          .objects = nullptr,
          .patience = 0,
          .waiting = HostFunctions::waiting,
          .given_up = HostFunctions::givenUp,
          .guard = 0,
          .reserved = 0,
          .inputs = nullptr,
          .coarser = HostFunctions::coarser};
}

}  // namespace grisaille::effect
