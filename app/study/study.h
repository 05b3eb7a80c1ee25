// SPDX-License-Identifier: MIT
// Measures every setting of a grid: the error against the truth of each camera once, and the cost
// in rounds over all settings (A B C A B C ...), so that other load of the machine affects all
// alike.
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
  // One per scene; all have the same registry, effects, output and size.
  std::vector<const Subject*> subjects;
  // The frames of a camera path through the first scene; the study fills in their `ao`. Null:
  // flicker is not measured.
  std::vector<trace::FlickerFrame>* path = nullptr;
  std::string key;  // everything that results depend on except setting and backend
  std::string machine, commit;
  uint32_t rounds = 5;
  std::filesystem::path folder;
  // Returns the command line that renders a setting's picture from the first camera of the first
  // scene.
  std::function<std::string(const SettingText&, const std::string& backend)> commandOf;
};

// Receives the progress: steps done, of all steps. A step renders all views of all scenes, or the
// camera path.
using Told = std::function<void(size_t done, size_t all)>;

class Study {
 public:
  // `desc` and `device` must outlive this. Reads the records that the folder holds; throws as
  // load() does.
  Study(const StudyDesc& desc, gpu::Device& device, std::vector<Setting> settings);

  // Continues from the folder's records, and saves a record after each step. Calls `stop` before
  // each step; returns false if `stop` returned true.
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

  // Starts the job's chain, unless it is started.
  effect::Chain& started(Job& job);

  const StudyDesc& desc_;
  std::vector<std::unique_ptr<Measurer>> measurers_;  // one per scene
  std::vector<Job> jobs_;
};

// The picture files of a record, for the first view: the picture, and its error against the truth
// (blue: too dark, orange: too bright, full colour at 0.25).
std::filesystem::path pictureOf(const std::filesystem::path& folder, const Record& record);
std::filesystem::path errorMapOf(const std::filesystem::path& folder, const Record& record);
// The picture file of the first view's truth.
std::filesystem::path truthPictureOf(const std::filesystem::path& folder);

}  // namespace grisaille::app::study
