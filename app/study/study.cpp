// SPDX-License-Identifier: MIT
#include "app/study/study.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "app/study/flicker_run.h"
#include "app/truth/error_map.h"
#include "core/gpu/device.h"

namespace grisaille::app::study {
namespace fs = std::filesystem;

fs::path pictureOf(const fs::path& folder, const Record& record) {
  return folder / "pictures" / (fileOf(folder, record).stem().string() + ".png");
}

fs::path errorMapOf(const fs::path& folder, const Record& record) {
  return folder / "pictures" / (fileOf(folder, record).stem().string() + "-error.png");
}

fs::path truthPictureOf(const fs::path& folder) {
  return folder / "pictures" / "truth.png";
}

Study::Study(const StudyDesc& desc, gpu::Device& device, std::vector<Setting> settings)
    : desc_(desc) {
  for (const Subject* subject : desc.subjects) {
    measurers_.push_back(std::make_unique<Measurer>(*subject, device));
  }
  const gpu::DeviceInfo& info = device.info();
  for (Setting& setting : settings) {
    Job job;
    Record& r = job.record;
    r.study = desc.key;
    r.setting = textOf(*desc.subjects.front()->registry, setting);
    job.setting = std::move(setting);
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

void Study::writePictures(const Record& record, const View& view, const image::Image& shown) {
  if (&view != &desc_.subjects.front()->views.front()) return;
  std::error_code failed;
  fs::create_directories(desc_.folder / "pictures", failed);
  image::write(shown, pictureOf(desc_.folder, record).string());
  image::write(truth::errorMap(truth::errorsOf(shown, view.truth)),
               errorMapOf(desc_.folder, record).string());
  if (fs::exists(truthPictureOf(desc_.folder))) return;
  image::Image truth = view.truth;
  for (float& value : truth.pixels) value = std::isnan(value) ? 1 : value;  // sky: visibility 1
  image::write(truth, truthPictureOf(desc_.folder).string());
}

effect::Chain& Study::started(Job& job) {
  if (!job.chain) job.chain = measurers_.front()->start(job.setting);
  return *job.chain;
}

void Study::measureErrors(Job& job) {
  const auto seen = [&](const View& view, const image::Image& shown) {
    writePictures(job.record, view, shown);
  };
  try {
    std::vector<CameraErrors> all;
    for (const auto& measurer : measurers_) {
      measurer->apply(job.setting, started(job));
      std::ranges::move(measurer->errors(*job.chain, seen), std::back_inserter(all));
    }
    job.record.errors = std::move(all);
  } catch (const Error& error) {
    throw Error(error.id(), "{}: {}", nameOf(job.record.setting), error.detail());
  }
  save(desc_.folder, job.record);
}

void Study::measureFlicker(Job& job) {
  measurers_.front()->apply(job.setting, started(job));
  const trace::Flicker along = flickerAlong(*desc_.path, [&](const scene::Camera& camera) {
    return measurers_.front()->show(*job.chain, camera);
  });
  job.record.flicker = along.rms;
  job.record.pathRmse = along.error;
  save(desc_.folder, job.record);
}

void Study::measureCost(Job& job) {
  const auto measured = [&] {
    std::vector<double> round;
    for (const auto& measurer : measurers_) {
      measurer->apply(job.setting, started(job));
      std::ranges::copy(measurer->costs(*job.chain), std::back_inserter(round));
    }
    return round;
  };
  if (!job.chain) measured();  // creates the pipelines, outside the measurement
  job.record.milliseconds.push_back(measured());
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
    if (!step(job.record.errors.empty(), [&] { measureErrors(job); })) return false;
    if (desc_.path == nullptr) continue;
    if (!step(!job.record.pathRmse, [&] { measureFlicker(job); })) return false;
  }
  for (uint32_t round = 0; round < desc_.rounds; ++round) {
    for (Job& job : jobs_) {
      const bool needed = job.record.milliseconds.size() <= round;
      if (!step(needed, [&] { measureCost(job); })) return false;
    }
  }
  return true;
}

}  // namespace grisaille::app::study
