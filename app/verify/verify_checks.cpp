// SPDX-License-Identifier: MIT
#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "app/services/placement.h"
#include "app/services/scene_services.h"
#include "app/verify/steady_check.h"
#include "app/verify/verify.h"
#include "backends/backends.h"
#include "core/effect/registry.h"
#include "core/effect/values.h"
#include "core/frame/renderer.h"

namespace grisaille::app {
namespace {

constexpr glm::uvec2 kSize(96, 54);
// Odd, small and thin sizes, most of them not multiples of a workgroup's size; then kSize again.
constexpr glm::uvec2 kSizes[] = {{1, 1}, {33, 17}, {7, 129}, {257, 3}, {64, 64}, {96, 54}};

// Number of random settings, and the picture size to render them at.
constexpr uint32_t kRandomVectors = 12;
constexpr glm::uvec2 kRandomSize(33, 21);

// A random value of a parameter: half the time from its soft range, else from its hard range on a
// linear or logarithmic scale, or an end of the hard range. The same on every machine.
double randomValue(const grisaille_param_desc& param, std::mt19937& random) {
  const double share = static_cast<double>(random()) * 0x1p-32;
  const double low = param.hard_min, high = param.hard_max;
  const auto kind = random() % 6;
  double value = share < 0.5 ? low : high;
  if (param.type == GRISAILLE_PARAM_BOOL || param.type == GRISAILLE_PARAM_ENUM) {
    value = low + share * (high - low + 1);
  } else if (kind < 3) {
    value = param.soft_min + share * (param.soft_max - param.soft_min);
  } else if (kind == 3 && low > 0) {
    value = low * std::pow(high / low, share);
  } else if (kind < 5) {
    value = (1 - share) * low + share * high;  // high - low can overflow
  }
  if (param.type != GRISAILLE_PARAM_FLOAT) value = std::floor(value);
  return std::clamp(value, low, high);
}

// Cameras of every kind that a host may have, from the atrium's.
struct CameraKind {
  const char* name;
  double orthographicHeight = 0;  // metres
  glm::dvec2 shift = glm::dvec2(0);
};
constexpr CameraKind kCameras[] = {
    {.name = "orthographic", .orthographicHeight = 6},
    {.name = "off-centre", .shift = glm::dvec2(0.4, -0.7)},
    {.name = "jittered", .shift = glm::dvec2(0.3 / kSize.x, -0.4 / kSize.y)},
    {.name = "orthographic, off-centre", .orthographicHeight = 3, .shift = glm::dvec2(-0.6, 0.2)}};

// Collects the messages of the driver and of the validation.
class Messages {
 public:
  explicit Messages(Report& report) : report_(report) {}

  gpu::MessageSink sink() {
    return [this](gpu::Severity severity, std::string_view text) {
      if (severity == gpu::Severity::kInfo) {
        report_.note(std::string(text));
      } else {
        heard_.emplace_back(text);
      }
    };
  }
  std::vector<std::string> take() { return std::exchange(heard_, {}); }

 private:
  Report& report_;
  std::vector<std::string> heard_;
};

// Checks one effect on one device.
class EffectCheck {
 public:
  EffectCheck(Report& report, gpu::Device& device, Messages& messages, const scene::Scene& scene,
              const effect::Registry& registry, const effect::Effect& effect,
              const std::string& backend)
      : report_(report),
        device_(device),
        messages_(messages),
        effect_(effect),
        title_(fmt::format("{}: {}: ", backend, effect.desc->key)),
        scene_(scene),
        renderer_(device, scene),
        services_(scene),
        chain_(effect::Selection(registry, std::array{std::string(effect.key())})) {
    for (const grisaille_output_desc& output : effect.outputs()) {
      names_.push_back(fmt::format("{}.{}", effect.desc->key, output.key));
    }
    placeObjects();
  }

  void run() {
    checkReads();
    if (!create()) return;
    const effect::Values values(effect_);
    draw("with its defaults", kSize, values, names_);
    report_.conclude(title_ + "draws complete pictures with its defaults");
    checkWrites(values);
    for (const glm::uvec2& size : kSizes) {
      draw(fmt::format("at {}x{}", size.x, size.y), size, values, names_);
    }
    report_.conclude(title_ + "draws at other sizes");
    for (const std::string& name : names_)
      draw("writing " + name + " alone", kSize, values, {name});
    report_.conclude(title_ + "writes each output alone");
    SteadyCheck(report_, device_, scene_, services_, chain_, names_, title_).run();
    heardNothing("drawing equal frames");
    checkCameras();
    checkExtremes();
    checkRandom();
    for (int i = 0; i < 3; ++i) {
      if (!create()) return;
      draw("created again", kSize, values, names_);
    }
    destroy();
    report_.conclude(title_ + "is destroyed and created again");
  }

 private:
  // Places a few objects in the picture if the effect has objects.
  void placeObjects() {
    objects::ObjectList* list = chain_.objects(effect_.key());
    if (list == nullptr) return;
    for (const glm::dvec2 at : {glm::dvec2(30, 30), glm::dvec2(48, 20), glm::dvec2(70, 40)}) {
      const auto object = placedAt(at, kSize, camera_, services_.rays(), list->table(),
                                   objects::Object(list->table()));
      if (object) list->add(*object);
    }
    objects_ = list->size();
  }

  void step(const std::string& what) { report_.step(title_ + what); }
  // `place`: which picture, "" without.
  void expect(bool holds, const std::string& place, const std::string& fault,
              std::string_view cause = {}) {
    const std::string colon = place.empty() ? "" : ": ";
    report_.expect(holds, title_ + place + colon + fault, cause.empty() ? fault : cause);
  }

  void heardNothing(const std::string& what) {
    for (const std::string& text : messages_.take()) {
      expect(false, what, "message of the driver or its validation: " + text);
    }
  }

  void destroy() {
    step("destroying it");
    try {
      chain_.end();
    } catch (const Error& error) {
      expect(false, "", error.detail());
    }
    heardNothing("destroying it");
  }

  // Creates the effect. Returns whether this succeeded.
  bool create() {
    destroy();
    step("creating it");
    bool created = false;
    try {
      chain_.start(device_);
      chain_.create();
      created = true;
      expect(true, "", "");
    } catch (const Error& error) {
      expect(false, "", error.detail());
    }
    heardNothing("creating it");
    return created;
  }

  void checkReads() {
    step("calling reads()");
    const effect::Values values(effect_);
    try {
      for (uint32_t wanted = 1; wanted < 1u << names_.size(); wanted <<= 1) {
        const uint32_t reads = effect_.reads(values.all().data(), wanted);
        expect(reads < 1u << GRISAILLE_ATTACHMENT_COUNT, "",
               fmt::format("reads() returns {:#x}, which has bits of no attachment", reads));
        expect(reads == effect_.reads(values.all().data(), wanted), "",
               "reads() returns different attachments for the same values");
      }
    } catch (const Error& error) {
      expect(false, "", error.detail());
    }
  }

  bool render(const std::string& what, glm::uvec2 size, const effect::Values& values,
              const std::vector<std::string>& outputs) {
    step(what);
    chain_.selection.entries()[0].values = values;
    try {
      renderer_.render({.camera = camera_,
                        .width = size.x,
                        .height = size.y,
                        .surface = frame::Surface::kBaseColour,  // for effects that read the colour
                        .chain = &chain_,
                        .outputs = outputs,
                        .services = services_.all()});
    } catch (const Error& error) {
      if (error.id() == ErrorId::kDeviceLost) throw;
      expect(false, what, error.detail());
      heardNothing(what);
      return false;
    }
    return true;
  }

  void draw(const std::string& what, glm::uvec2 size, const effect::Values& values,
            const std::vector<std::string>& outputs) {
    if (!render(what, size, values, outputs)) return;
    for (const std::string& name : outputs) {
      const auto index = std::ranges::find(names_, name) - names_.begin();
      const std::string which = fmt::format("{}: {}", what, name);
      try {
        checkPicture(which, effect_.outputs()[static_cast<size_t>(index)], renderer_.read(name));
      } catch (const Error& error) {
        if (error.id() == ErrorId::kDeviceLost) throw;
        const bool unwritten = error.id() == ErrorId::kUninitialised;
        expect(false, which, unwritten ? "it is not written" : "cannot be read: " + error.detail(),
               unwritten ? notWritten(name) : "");
      }
    }
    heardNothing(what);
  }

  // The cause of a fault.
  static std::string notWritten(const std::string& output) { return output + " is not written"; }

  // Checks that all values are finite and in the range of the output's role.
  void checkPicture(const std::string& what, const grisaille_output_desc& output,
                    const image::Image& picture) {
    constexpr float kRounding = 1e-3f;
    size_t odd = 0, outside = 0, nobodys = 0;
    for (size_t i = 0; i < picture.pixels.size(); ++i) {
      const float value = picture.pixels[i];
      if (!std::isfinite(value)) ++odd;
      const size_t channel = i % picture.channels;
      const bool share = (output.role == GRISAILLE_ROLE_VISIBILITY && channel == 0) ||
                         (output.role == GRISAILLE_ROLE_TINT && channel < 3) ||
                         (output.role == GRISAILLE_ROLE_OVERLAY && channel == 3);
      if (share && (value < -kRounding || value > 1 + kRounding)) ++outside;
      const auto objects = static_cast<float>(objects_);
      if (output.role == GRISAILLE_ROLE_OWNER && value > objects) ++nobodys;
    }
    const std::string name = output.key;
    const auto count = [&](size_t values, const char* fault) {
      expect(values == 0, "", fmt::format("{} holds {} {}", what, values, fault), name + fault);
    };
    count(odd, "values that are not finite");
    count(outside, "values outside 0 to 1");
    count(nobodys, "numbers that no object has");
  }

  // Fills the output with the byte `before`, then renders. A texel of `left` stays 1 only if the
  // effect left it unchanged.
  void findLeft(const std::string& name, std::byte before, const effect::Values& values,
                std::vector<uint8_t>& left, size_t texel) {
    const gpu::Texture texture = renderer_.texture(name);
    const std::vector<std::byte> fill(left.size() * texel, before);
    device_.begin().upload(texture, 0, 0, fill);
    device_.submit();
    if (!render("over " + name + ", which was filled", kSize, values, {name})) return;
    const std::vector<std::byte> bytes = device_.read(renderer_.texture(name));
    for (size_t i = 0; i < left.size(); ++i) {
      const bool same = std::memcmp(&bytes[i * texel], &fill[i * texel], texel) == 0;
      left[i] = left[i] != 0 && same ? 1 : 0;
    }
  }

  // Checks that the effect writes every pixel of every output. A pixel that keeps both of two
  // different fills was not written.
  void checkWrites(const effect::Values& values) {
    for (size_t i = 0; i < names_.size(); ++i) {
      if (!render("writing " + names_[i], kSize, values, {names_[i]})) continue;
      const size_t texel =
          gpu::formatInfo(effect::formatOf(effect_.outputs()[i].format)).texelBytes;
      std::vector<uint8_t> left(size_t{kSize.x} * kSize.y, 1);
      findLeft(names_[i], std::byte{0x3b}, values, left, texel);
      findLeft(names_[i], std::byte{0x27}, values, left, texel);
      const auto count = std::ranges::count(left, 1);
      expect(count == 0, "",
             fmt::format("{} of {} pixels of {} are not written", count, left.size(), names_[i]),
             notWritten(names_[i]));
    }
    heardNothing("writing every pixel");
    report_.conclude(title_ + "writes every pixel");
  }

  void drawWith(const grisaille_param_desc& param, double value) {
    effect::Values values(effect_);
    values.set(param.key, value);
    draw(fmt::format("{} = {}", param.key, values.text(param.key)), kSize, values, names_);
  }

  // Each camera twice: an effect that keeps a history then uses it.
  void checkCameras() {
    const effect::Values values(effect_);
    for (const CameraKind& kind : kCameras) {
      camera_ = scene::atriumCamera();
      camera_.orthographicHeight = kind.orthographicHeight;
      camera_.shift = kind.shift;
      const std::string what = fmt::format("with an {} camera", kind.name);
      for (int i = 0; i < 2; ++i) draw(what, kSize, values, names_);
    }
    camera_ = scene::atriumCamera();
    report_.conclude(title_ + "draws with cameras of every kind");
  }

  void checkExtremes() {
    effect::Values least(effect_), most(effect_);
    for (const grisaille_param_desc& param : effect_.params()) {
      const bool number = param.type == GRISAILLE_PARAM_FLOAT || param.type == GRISAILLE_PARAM_INT;
      if (number) {
        drawWith(param, param.hard_min);
        drawWith(param, param.hard_max);
      } else {
        const auto last = static_cast<uint32_t>(param.hard_max);
        for (uint32_t entry = 0; entry <= last; ++entry) drawWith(param, entry);
      }
      least.set(param.key, param.hard_min);
      most.set(param.key, param.hard_max);
    }
    draw("all parameters at their minimum", kSize, least, names_);
    draw("all parameters at their maximum", kSize, most, names_);
    report_.conclude(title_ + "draws with every parameter at its extremes");
  }

  void checkRandom() {
    std::mt19937 random(1);
    for (uint32_t i = 0; i < kRandomVectors; ++i) {
      effect::Values values(effect_);
      std::string what = "with";
      for (const grisaille_param_desc& param : effect_.params()) {
        values.set(param.key, randomValue(param, random));
        what += fmt::format(" {}={}", param.key, values.text(param.key));
      }
      draw(what, kRandomSize, values, names_);
    }
    report_.conclude(title_ + "draws with random values");
  }

  Report& report_;
  gpu::Device& device_;
  Messages& messages_;
  const effect::Effect& effect_;
  const std::string title_;
  scene::Camera camera_ = scene::atriumCamera();
  const scene::Scene& scene_;
  frame::Renderer renderer_;
  SceneServices services_;
  std::vector<std::string> names_;  // full names of the outputs
  size_t objects_ = 0;
  effect::Chain chain_;  // only this effect
};

// A lost device ends the check of this effect with a fault.
void checkEffect(Report& report, gpu::Device& device, Messages& messages, const scene::Scene& scene,
                 const effect::Registry& registry, const effect::Effect& effect,
                 const std::string& backend) {
  try {
    EffectCheck(report, device, messages, scene, registry, effect, backend).run();
  } catch (const Error& error) {
    report.fault(fmt::format("{}: {}: the check did not finish: {}", backend, effect.desc->key,
                             error.detail()));
  }
}

// Loads and unloads the plugin several times, then loads it into `registry`.
bool checkLoading(const std::string& file, effect::Registry& registry, Report& report) {
  try {
    for (int i = 0; i < 3; ++i) {
      report.step("loading and unloading " + file);
      effect::Registry().load(file);
      // The absolute path that load() used; dlopen() searches a bare name in system folders.
      const std::string path = std::filesystem::absolute(file);
      void* left = dlopen(path.c_str(), RTLD_LAZY | RTLD_NOLOAD);
      report.expect(left == nullptr,
                    "it stays in memory after unloading, and a newer build cannot be loaded: "
                    "build it with -fno-gnu-unique");
      if (left != nullptr) dlclose(left);
    }
    report.step("loading " + file);
    registry.load(file);
  } catch (const Error& error) {
    report.fault(error.detail());
    return false;
  }
  for (const effect::Effect& effect : registry.effects()) {
    report.expect(true, "");
    report.conclude(fmt::format("{} {}: its tables of {} parameters and {} outputs are valid",
                                effect.desc->key, effect.desc->version, effect.params().size(),
                                effect.outputs().size()));
  }
  return true;
}

}  // namespace

void checkPlugin(const std::string& file, Report& report) {
  effect::Registry registry;
  if (!checkLoading(file, registry, report)) return;
  const scene::Scene scene = scene::makeAtrium();
  size_t devices = 0;
  for (const backends::Backend& backend : backends::all()) {
    Messages messages(report);
    std::unique_ptr<gpu::Device> device;
    report.step(fmt::format("{}: starting a device", backend.name));
    try {
      device = backends::create(backend.name, {.check = true, .message = messages.sink()});
    } catch (const Error& error) {
      report.note(fmt::format("{}: not checked: {}", backend.name, error.detail()));
      continue;
    }
    ++devices;
    for (const effect::Effect& effect : registry.effects()) {
      checkEffect(report, *device, messages, scene, registry, effect, backend.name);
    }
    device.reset();
    for (const std::string& text : messages.take()) {
      report.fault(fmt::format("{}: at the end: {}", backend.name, text));
    }
  }
  report.expect(devices > 0, "no backend starts; nothing was drawn");
}

}  // namespace grisaille::app
