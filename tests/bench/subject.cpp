// SPDX-License-Identifier: MIT
#include "tests/bench/subject.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "tests/support/scenes.h"

namespace grisaille::bench {

Subject loadSubject() {
  using Clock = std::chrono::steady_clock;
  const char* given = std::getenv("GRISAILLE_SPONZA");
  const std::filesystem::path file =
      given != nullptr ? std::filesystem::path(given)
                       : std::filesystem::path(SOURCE_FOLDER) / "../shared/scenes/Sponza.glb";
  Subject subject;
  const auto start = Clock::now();
  if (std::filesystem::exists(file)) {
    subject.name = "Crytek Sponza";
    subject.scene = scene::loadGltf(file);
    for (const char* camera : {"atrium", "arcade", "gallery", "lion"}) {
      subject.cameras.push_back(
          scene::loadCamera((file.parent_path() / "../cameras" / camera).string() + ".json"));
    }
  } else {
    fmt::print(stderr, "Sponza is not there: measuring the built-in atrium\n");
    subject.name = "the built-in atrium";
    subject.scene = scene::makeAtrium();
    subject.cameras.push_back(scene::atriumCamera());
  }
  subject.loadSeconds = std::chrono::duration<double>(Clock::now() - start).count();
  return subject;
}

Subject wallSubject() {
  Subject subject;
  subject.name = "a bare wall";
  subject.scene = tests::wallScene(16, 9);
  subject.cameras.push_back({.eye = glm::dvec3(0, 0, 7.5), .target = glm::dvec3(0, 0, 0)});
  return subject;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace grisaille::bench
