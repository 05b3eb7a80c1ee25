// SPDX-License-Identifier: MIT
// Scenes for the benchmarks.
#pragma once

#include <string>
#include <vector>

#include "core/scene/camera.h"
#include "core/scene/scene.h"

namespace grisaille::bench {

// Sponza with its four cameras if the file exists, otherwise the built-in atrium with one camera.
struct Subject {
  std::string name;
  scene::Scene scene;
  std::vector<scene::Camera> cameras;
  double loadSeconds = 0;
};

// Loads the file from GRISAILLE_SPONZA or from the project's folder.
Subject loadSubject();

// A bare wall of 16 x 9 m that fills the camera's picture.
Subject wallSubject();

// `values` must not be empty.
double median(std::vector<double> values);

}  // namespace grisaille::bench
