// SPDX-License-Identifier: MIT
// What a study knows of one setting on one backend: a file of its own in the study's folder,
// written aside after every step, so that an interruption loses the step in progress alone and the
// parts of a study that was split are put together by putting their files together.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/study/sweep.h"

namespace grisaille::app::study {

// Against the truth of one camera, over the pixels that see a surface.
struct CameraErrors {
  std::string camera;  // as it was given
  double rmse = 0, meanAbsolute = 0, bias = 0, percentile99 = 0, ssim = 0;

  bool operator==(const CameraErrors&) const = default;
};

// 0: there are none.
double medianOf(const std::vector<double>& values);

struct Record {
  std::string study;  // all that results depend on but setting and backend
  SettingText setting;
  std::string backend, device, driver, clock;
  std::string machine, commit;
  std::string command;               // that makes its picture of the first camera
  std::vector<CameraErrors> errors;  // one a camera, once they are known
  std::vector<double> milliseconds;  // the effects' passes, mean of the cameras, one a round
  // Along the study's camera path, where it has one: trace::Flicker's rms and error.
  std::optional<double> flicker, pathRmse;

  bool operator==(const Record&) const = default;

  double rmse() const;    // mean of the cameras
  double cost() const;    // median, milliseconds; 0: none yet
  double spread() const;  // from the first quartile to the third, milliseconds
};

// DIR/records/<hash of study, setting, backend>.json
std::filesystem::path fileOf(const std::filesystem::path& folder, const Record& record);

void save(const std::filesystem::path& folder, const Record& record);

// None: there is no file, or it is of another study. Throws kStudyRecord where it is damaged
// or no regular file.
std::optional<Record> load(const std::filesystem::path& file);

// All of a folder, by the name of their files.
std::vector<Record> loadAll(const std::filesystem::path& folder);

}  // namespace grisaille::app::study
