// SPDX-License-Identifier: MIT
#include "app/study/study.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace grisaille::app::study {
namespace fs = std::filesystem;
namespace {

// Where there is a surface; elsewhere a copy of what it is compared with.
image::Image onSurfaces(const image::Image& picture, const image::Image& truth, float elsewhere) {
  image::Image result = picture;
  for (size_t i = 0; i < result.pixels.size(); ++i) {
    if (!std::isfinite(truth.pixels[i])) result.pixels[i] = elsewhere;
  }
  return result;
}

}  // namespace

image::Image errorMap(const image::Image& shown, const image::Image& truth, float full) {
  image::Image map{shown.width, shown.height, 3, {}};
  map.pixels.resize(shown.pixels.size() * 3);
  const glm::vec3 dark(0.0f, 0.45f, 0.70f), bright(0.90f, 0.62f, 0.0f);  // Okabe and Ito
  for (size_t i = 0; i < shown.pixels.size(); ++i) {
    glm::vec3 color(0.5f);
    if (std::isfinite(truth.pixels[i])) {
      const float error = (shown.pixels[i] - truth.pixels[i]) / full;
      color = glm::mix(glm::vec3(1), error < 0 ? dark : bright, std::min(std::abs(error), 1.0f));
    }
    for (int c = 0; c < 3; ++c) map.pixels[i * 3 + static_cast<size_t>(c)] = color[c];
  }
  return map;
}

double costOf(const std::vector<gpu::FrameTimes>& frames, const std::vector<std::string>& effects) {
  double sum = 0;
  for (const gpu::FrameTimes& frame : frames) {
    for (const gpu::PassTime& pass : frame.passes) {
      const std::string effect = pass.label.substr(0, pass.label.find('/'));
      if (std::ranges::find(effects, effect) != effects.end()) sum += pass.milliseconds;
    }
  }
  return frames.empty() ? 0 : sum / static_cast<double>(frames.size());
}

fs::path pictureOf(const fs::path& folder, const Record& record) {
  return folder / "pictures" / (fileOf(folder, record).stem().string() + ".png");
}

fs::path errorMapOf(const fs::path& folder, const Record& record) {
  return folder / "pictures" / (fileOf(folder, record).stem().string() + "-error.png");
}

Study::Study(const StudyDesc& desc, gpu::Device& device, std::vector<Setting> settings)
    : desc_(desc), device_(device), rays_(*desc.scene), renderer_(device, *desc.scene) {
  const gpu::DeviceInfo& info = device.info();
  for (Setting& setting : settings) {
    Job job;
    Record& r = job.record;
    r.study = desc.key;
    r.setting = std::move(setting);
    r.backend = info.backend;
    if (auto known = load(fileOf(desc.folder, r)); known && known->study == desc.key) {
      r = std::move(*known);
    } else {
      r.device = info.name;
      r.driver = info.driver;
      r.clock = gpu::clockName(info.clock);
      r.machine = desc.machine;
      r.commit = desc.commit;
      r.command = desc.commandOf(r.setting, r.backend);
    }
    jobs_.push_back(std::move(job));
  }
}

void Study::start(Job& job) {
  if (job.active) return;
  job.active = std::make_unique<ActiveEffects>(*desc_.registry, desc_.effects);
  for (const std::string& set : desc_.sets) job.active->set(set);
  for (const auto& [name, value] : job.record.setting) job.active->set(name + "=" + value);
  job.instances = job.active->start(device_);
}

void Study::render(Job& job, const scene::Camera& camera) {
  const std::vector<std::string> outputs = {desc_.output};
  const std::vector<frame::ActiveEffect> effects = job.active->with(job.instances);
  renderer_.render({.camera = camera,
                    .width = desc_.size.x,
                    .height = desc_.size.y,
                    .effects = effects,
                    .outputs = outputs,
                    .rays = &rays_});
}

void Study::measureErrors(Job& job) {
  std::vector<CameraErrors> errors;
  for (const View& view : desc_.views) {
    render(job, view.camera);
    const image::Image shown = renderer_.read(desc_.output);
    if (shown.channels != 1) {
      throw Error(ErrorId::kUsage, "output '{}' has {} channels; truth has one", desc_.output,
                  shown.channels);
    }
    const image::Difference d = image::compare(shown, view.truth);
    errors.push_back(
        {view.name, d.rmse, d.meanAbsolute, d.bias, d.percentile99,
         image::ssim(onSurfaces(shown, view.truth, 1), onSurfaces(view.truth, view.truth, 1))
             .mean});
    if (&view != &desc_.views.front()) continue;
    std::error_code failed;
    fs::create_directories(desc_.folder / "pictures", failed);
    image::write(shown, pictureOf(desc_.folder, job.record).string());
    image::write(errorMap(shown, view.truth), errorMapOf(desc_.folder, job.record).string());
  }
  job.record.errors = std::move(errors);
  save(desc_.folder, job.record);
}

void Study::measureFlicker(Job& job) {
  job.record.flicker = flickerAlong(*desc_.path, [&](const scene::Camera& camera) {
                         render(job, camera);
                         return renderer_.read(desc_.output);
                       }).rms;
  save(desc_.folder, job.record);
}

void Study::measureCost(Job& job) {
  device_.wait();
  device_.takeTimes();
  for (const View& view : desc_.views) render(job, view.camera);
  device_.wait();
  const std::vector<gpu::FrameTimes> frames = device_.takeTimes();
  if (!frames.empty()) job.record.milliseconds.push_back(costOf(frames, desc_.effects));
  save(desc_.folder, job.record);
}

bool Study::run(const Told& told, const std::function<bool()>& stop) {
  const size_t all = jobs_.size() * (desc_.rounds + (desc_.path == nullptr ? 1 : 2));
  size_t done = 0;
  const auto step = [&](bool needed, const std::function<void()>& work) {
    if (needed) {
      if (stop()) return false;
      work();
    }
    told(++done, all);
    return true;
  };
  for (Job& job : jobs_) {
    const bool needed = job.record.errors.empty();
    if (!step(needed, [&] { start(job), measureErrors(job); })) return false;
    if (desc_.path == nullptr) continue;
    if (!step(!job.record.flicker, [&] { start(job), measureFlicker(job); })) return false;
  }
  for (uint32_t round = 0; round < desc_.rounds; ++round) {
    for (Job& job : jobs_) {
      const bool needed = job.record.milliseconds.size() <= round;
      const auto work = [&] {
        const bool fresh = !job.active;
        start(job);
        if (fresh) render(job, desc_.views.front().camera);  // pipelines are made outside the clock
        measureCost(job);
      };
      if (!step(needed, work)) return false;
    }
  }
  return true;
}

}  // namespace grisaille::app::study
