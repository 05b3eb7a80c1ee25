// SPDX-License-Identifier: MIT
// Measures every setting of a grid: its error against the truth of each camera, once, and its cost,
// round by round over all settings (A B C A B C ...), so that what disturbs the machine is shared.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/study/measurer.h"
#include "app/study/record.h"
#include "core/trace/flicker.h"

namespace grisaille::app::study {

struct StudyDesc {
  Subject subject;
  // A camera path's frames, whose pictures the study fills in; null: no flicker is measured.
  std::vector<trace::FlickerFrame>* path = nullptr;
  std::string key;  // all that results depend on but setting and backend
  std::string machine, commit;
  uint32_t rounds = 5;
  std::filesystem::path folder;
  // The command that makes a setting's picture from the first camera.
  std::function<std::string(const SettingText&, const std::string& backend)> commandOf;
};

// What is done of all that there is to do, in renderings of all views.
using Told = std::function<void(size_t done, size_t all)>;

class Study {
 public:
  // All outlive this.
  Study(const StudyDesc& desc, gpu::Device& device, std::vector<Setting> settings);

  // Begins where the folder's records end; `stop` is asked before each step. False where it
  // stopped.
  bool run(const Told& told, const std::function<bool()>& stop);

 private:
  struct Job {
    Record record;
    Setting setting;
    std::unique_ptr<effect::Chain> chain;  // null: not started
  };

  void measureErrors(Job& job);
  void measureFlicker(Job& job);
  void measureCost(Job& job);
  void writePictures(const Record& record, const View& view, const image::Image& shown);

  const StudyDesc& desc_;
  Measurer measurer_;
  std::vector<Job> jobs_;
};

// Pictures of a record: what it shows of the first view, and how that differs from the truth: blue
// where it is too dark, orange where it is too bright, full at 0.25.
std::filesystem::path pictureOf(const std::filesystem::path& folder, const Record& record);
std::filesystem::path errorMapOf(const std::filesystem::path& folder, const Record& record);
// The truth of the first view.
std::filesystem::path truthPictureOf(const std::filesystem::path& folder);

}  // namespace grisaille::app::study
