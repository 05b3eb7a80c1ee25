// SPDX-License-Identifier: MIT
// The measurements of one setting on one backend, in a file of its own in the study's folder. The
// file is written atomically after every step, so that an interruption loses only the step in
// progress. To join the parts of a study, copy their files into one folder.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/study/sweep.h"

namespace grisaille::app::study {

// Errors against the truth of one camera, over the pixels that see a surface.
struct CameraErrors {
  std::string scene;   // name of the view's scene; "": the study's only one
  std::string camera;  // name of the view
  double rmse = 0, meanAbsolute = 0, bias = 0, percentile99 = 0, ssim = 0;

  bool operator==(const CameraErrors&) const = default;
};

// The median; 0 if there are no values.
double medianOf(const std::vector<double>& values);

struct Record {
  std::string study;  // everything that results depend on except setting and backend
  SettingText setting;
  std::string backend, device, driver, clock;
  std::string machine, commit;
  std::string command;               // command line that renders the picture of the first camera
  std::vector<CameraErrors> errors;  // one per camera; empty: not measured yet
  // Cost of the effects: for each round, one value per camera.
  std::vector<std::vector<double>> milliseconds;
  // trace::Flicker's rms and error along the study's camera path; none: no path, or not measured
  // yet.
  std::optional<double> flicker, pathRmse;

  bool operator==(const Record&) const = default;

  // The share of each camera in a mean, one per element of `errors`: every scene has the same
  // share, and every camera of a scene. The sum is 1.
  std::vector<double> shares() const;

  double rmse() const;  // mean by shares()
  double cost()
      const;  // median of the rounds' means by shares(), milliseconds; 0: not measured yet
  double spread() const;  // distance of those means' first and third quartile, milliseconds
  double costOf(size_t camera) const;  // median of the rounds, milliseconds; 0: not measured yet
};

// DIR/records/<hash of study, setting, backend>.json
std::filesystem::path fileOf(const std::filesystem::path& folder, const Record& record);

// Writes fileOf(). Throws kFileUnwritable.
void save(const std::filesystem::path& folder, const Record& record);

// Reads a record; none if the file does not exist. Throws kStudyRecord if the file is damaged, not
// a regular file or of another version.
std::optional<Record> load(const std::filesystem::path& file);

// All records of a study's folder, in the order of their file names. Throws as load() does.
std::vector<Record> loadAll(const std::filesystem::path& folder);

}  // namespace grisaille::app::study
