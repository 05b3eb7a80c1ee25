// SPDX-License-Identifier: MIT
// What the benchmarks measure on.
#pragma once

#include <string>
#include <vector>

#include "core/scene/camera.h"
#include "core/scene/scene.h"

namespace grisaille::bench {

// Sponza and its four cameras where they are there, else the built-in atrium and its one.
struct Subject {
  std::string name;
  scene::Scene scene;
  std::vector<scene::Camera> cameras;
  double loadSeconds = 0;
};

// The file that GRISAILLE_SPONZA names, or where the project keeps it.
Subject loadSubject();

// A bare wall of 16 x 9 m that fills its camera's picture.
Subject wallSubject();

// Not of an empty list.
double median(std::vector<double> values);

}  // namespace grisaille::bench
