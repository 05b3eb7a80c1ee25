// SPDX-License-Identifier: MIT
#include "tests/bench/sspm_load.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "backends/backends.h"
#include "core/objects/object_file.h"
#include "tests/bench/painted.h"

namespace grisaille::bench {
namespace {

constexpr double kLoadPatience = 0.03;  // seconds a frame for placing, as in the viewer

// A file of shots in the temporary folder, which goes with this object.
class ShotFile {
 public:
  ShotFile(const objects::Table& table, std::span<const lab::Shot> shots)
      : path_(std::filesystem::temp_directory_path() /
              fmt::format("grisaille_{}_shots.json", shots.size())) {
    objects::save(objectsOf(table, shots).view(), path_.string());
  }
  ~ShotFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  ShotFile(const ShotFile&) = delete;
  ShotFile& operator=(const ShotFile&) = delete;

  std::string path() const { return path_.string(); }
  double megabytes() const { return static_cast<double>(std::filesystem::file_size(path_)) / 1e6; }

 private:
  std::filesystem::path path_;
};

}  // namespace

void printLoad(const std::string& backend, const Subject& subject, const effect::Registry& registry,
               tests::TracedRays& rays, std::span<const lab::Shot> shots,
               std::span<const size_t> counts, uint32_t width, uint32_t height) {
  const auto device = backends::create(backend, {});
  fmt::print(
      "## {}, {}: a file of shots\n\n"
      "The first frame after the load has {:.0f} ms for placing. Placed: shots that it shows, the "
      "newest.\nPainted: its pixels with paint, on the first camera.\n\n"
      "| shots | file, MB | to read it, s | first frame, ms | placed | painted "
      "|\n|---|---|---|---|---|---|\n",
      subject.name, backend, 1000 * kLoadPatience);
  for (const size_t count : counts) {
    if (count > shots.size()) continue;
    Painted painted(*device, subject, registry, rays, kPaintAndAo);
    painted.outputs() = {"color", "sspm.paint_coverage"};
    const Painted::View view = {subject.cameras[0], width, height, kLoadPatience};
    painted.render(view);
    const ShotFile file(painted.shots().table(), shots.first(count));
    const auto start = Clock::now();
    painted.shots().add(objects::load(painted.shots().table(), file.path()).view());
    const double read = secondsSince(start);
    const double first = painted.render(view);
    const image::Image coverage = painted.read("sspm.paint_coverage");
    const auto covered =
        std::ranges::count_if(coverage.pixels, [](float value) { return value > 0; });
    fmt::print("| {} | {:.0f} | {:.2f} | {:.0f} | {} | {:.2f} % |\n", count, file.megabytes(), read,
               first, count - painted.report().waiting,
               100 * static_cast<double>(covered) / static_cast<double>(coverage.pixels.size()));
    std::fflush(stdout);
  }
  fmt::print("\n");
}

}  // namespace grisaille::bench
