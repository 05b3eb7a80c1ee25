// SPDX-License-Identifier: MIT
// Measures what paint costs against the number of shots. Times a frame for each count in turn in
// one process (A B C A B C ...) and takes ratios round by round. Also measures memory and the cost
// of one more shot.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/effect/registry.h"
#include "lab/paint/shot.h"
#include "tests/bench/command.h"
#include "tests/bench/subject.h"
#include "tests/support/traced_rays.h"

namespace grisaille::bench {

using Shots = std::vector<lab::Shot>;

// Where shots are fired, and how many.
struct Place {
  // counts, perShotCounts: of shots, for the modes `surface` and `per_shot`, ascending.
  // extra: counts of shots for other measurements.
  Place(Subject theSubject, std::vector<size_t> theCounts, std::vector<size_t> thePerShotCounts,
        const std::vector<size_t>& extra);

  Subject subject;
  std::vector<size_t> counts, perShotCounts;
  std::unique_ptr<tests::TracedRays> rays;
  Shots shots;
};

// What was measured of one number of shots; a value for each round in the vectors.
struct Row {
  std::string mode;
  size_t shots = 0;
  double range = 0, painted = 0;  // metres; share of the pixels
  std::vector<double> effect = {}, frame = {}, effectRatio = {}, frameRatio = {};
  double placeSeconds = 0, raysAShot = 0, memory = 0, bytesAShot = 0;
  uint64_t coarser = 0, givenUp = 0;  // shots, at the limit of memory
};

// One curve of the plot.
struct Curve {
  std::string title;
  std::vector<Row> rows;
};

// Measures one place on one backend, prints the result and adds its curves. memory: value of the
// parameter, MB.
void measureCost(const std::string& backend, const Place& place, const effect::Registry& registry,
                 const CommonOptions& options, uint32_t memory, std::vector<Curve>& curves);

// Writes FOLDER/paint_cost.csv and the plot of it.
void writePlot(const std::filesystem::path& folder, const std::vector<Curve>& curves);

}  // namespace grisaille::bench
