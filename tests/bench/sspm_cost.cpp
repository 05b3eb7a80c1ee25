// SPDX-License-Identifier: MIT
#include "tests/bench/sspm_cost.h"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <fstream>
#include <random>

#include "backends/backends.h"
#include "tests/bench/painted.h"

namespace grisaille::bench {
namespace {

constexpr double kRange = 0.25;    // of shots, metres: the default
constexpr double kPatience = 0.5;  // seconds for placing shots in a frame

// Resident memory of this process, MiB. On a software driver it includes the device's memory.
double residentMemory() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("VmRSS:")) return std::stod(line.substr(6)) / 1024;
  }
  return 0;
}

// Shots from anywhere around the cameras at any surface that they see, as in a game.
Shots randomShots(const Subject& subject, const trace::RayTracer& tracer, size_t count) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  std::uniform_real_distribution<float> channel(0, 1);
  constexpr uint32_t kWidth = 1280, kHeight = 720;
  std::vector<std::vector<trace::Hit>> views;
  for (const scene::Camera& camera : subject.cameras) {
    views.push_back(tracer.castPrimary(camera, kWidth, kHeight));
  }
  Shots shots;
  shots.reserve(count + 1024);
  while (shots.size() < count) {
    const size_t view = random() % views.size();
    const trace::Hit& target = views[view][random() % views[view].size()];
    const glm::dvec3 muzzle =
        subject.cameras[view].eye +
        glm::dvec3(3 * unit(random) - 1.5, 1.5 * unit(random) - 0.7, 3 * unit(random) - 1.5);
    const glm::dvec3 way = target.position - muzzle;
    if (target.viewDepth == 0 || glm::length(way) < 0.1) continue;
    const glm::vec3 direction(glm::normalize(way));
    shots.push_back({.origin = {muzzle.x, muzzle.y, muzzle.z},
                     .direction = {direction.x, direction.y, direction.z},
                     .color = {channel(random), channel(random), channel(random)},
                     .range = 0});
  }
  return shots;
}

// Share of the pixels that have paint.
double shareOf(Painted& painted, const Painted::View& view) {
  const auto color = std::exchange(painted.outputs(), {"sspm.paint_coverage"});
  painted.render(view);
  painted.outputs() = color;
  const image::Image coverage = painted.read("sspm.paint_coverage");
  const auto count = std::ranges::count_if(coverage.pixels, [](float it) { return it > 0; });
  return static_cast<double>(count) / static_cast<double>(coverage.pixels.size());
}

class Bench {
 public:
  Bench(const std::string& backend, const Place& place, const effect::Registry& registry,
        const CommonOptions& options, uint32_t memory)
      : options_(options),
        memory_(memory),
        place_(place),
        registry_(registry),
        device_(backends::create(backend, {.timed = true})) {}

  const gpu::DeviceInfo& info() const { return device_->info(); }

  std::vector<Row> run() {
    for (const size_t count : place_.counts) place("surface", count, kRange);
    const double most = rows_.back().painted;
    place("surface", place_.counts.front(), rangeFor(place_.counts.front(), most));
    std::rotate(rows_.begin(), rows_.end() - 1, rows_.end());
    std::rotate(painted_.begin(), painted_.end() - 1, painted_.end());
    for (const size_t count : place_.perShotCounts) place("per_shot", count, kRange);
    for (uint32_t round = 0; round < options_.rounds; ++round) {
      fmt::print(stderr, "round {} of {}\n", round + 1, options_.rounds);
      double firstEffect = 0, firstFrame = 0;
      for (size_t i = 0; i < rows_.size(); ++i) {
        Row& row = rows_[i];
        painted_[i]->render(large());
        const auto [effect, frame] = passes();
        if (i == 0) std::tie(firstEffect, firstFrame) = std::pair(effect, frame);
        row.effect.push_back(effect);
        row.frame.push_back(frame);
        row.effectRatio.push_back(effect / firstEffect);
        row.frameRatio.push_back(frame / firstFrame);
      }
    }
    return rows_;
  }

  // Milliseconds that one more shot adds to a frame of few pixels, with the highest number of
  // shots. Each frame with a new shot follows a frame without one.
  std::vector<double> oneMore(size_t times) {
    const size_t which = place_.counts.size();
    std::mt19937 random(2);
    std::vector<double> more;
    for (size_t i = 0; i < times; ++i) {
      const double without = painted_[which]->render(small());
      lab::Shot shot = place_.shots[random() % place_.shots.size()];
      shot.origin[1] += 1e-3;  // a shot that is not in the list yet
      painted_[which]->add({&shot, 1});
      more.push_back(painted_[which]->render(small()) - without);
    }
    device_->takeTimes();
    std::ranges::sort(more);
    return more;
  }

 private:
  const scene::Camera& camera() const { return place_.subject.cameras[0]; }
  Painted::View large() const { return {camera(), options_.width, options_.height}; }
  Painted::View small() const { return {camera(), 64, 36}; }

  // Milliseconds of the last frame: of the effect's passes, and of all passes.
  std::pair<double, double> passes() {
    double effect = 0, all = 0;
    const std::vector<gpu::FrameTimes> frames = device_->takeTimes();
    for (const gpu::PassTime& pass : frames.back().passes) {
      all += pass.milliseconds;
      if (pass.label.starts_with("sspm/")) effect += pass.milliseconds;
    }
    return {effect, all};
  }

  // Range with which a number of shots paints as many pixels as `share`, by bisection.
  double rangeFor(size_t count, double share) {
    Painted painted(*device_, place_.subject, registry_, *place_.rays, kPaintAndAo);
    painted.add(std::span(place_.shots).first(count));
    double low = kRange, high = 16;
    for (int i = 0; i < 10; ++i) {
      const double middle = std::sqrt(low * high);
      painted.values().set("paint_range", fmt::format("{}", middle));
      (shareOf(painted, large()) < share ? low : high) = middle;
    }
    device_->takeTimes();
    return high;
  }

  void place(const char* mode, size_t count, double range) {
    fmt::print(stderr, "{}: {} shots\n", mode, count);
    painted_.push_back(
        std::make_unique<Painted>(*device_, place_.subject, registry_, *place_.rays, kPaintAndAo));
    Painted& painted = *painted_.back();
    painted.values().set("mode", mode);
    painted.values().set("shot_limit", "65536");
    painted.values().set("memory", std::to_string(memory_));
    painted.values().set("paint_range", fmt::format("{}", range));
    painted.render(large());
    const double idle = painted.render(small());
    // The textures of a large frame are in the figure before as well as in the one after.
    painted.render(large());
    painted.add(std::span(place_.shots).first(count));
    malloc_trim(0);  // otherwise memory freed by earlier runs would be reused unseen
    const double memory = residentMemory();  // includes the host's list of shots
    const size_t rays = place_.rays->count();
    const double took = painted.settle(kPatience) - idle;
    // Until the device has finished with the frame that uploaded the paint.
    for (int i = 0; i < 4; ++i) painted.render(large());
    const auto each = static_cast<double>(count);
    malloc_trim(0);
    const double grown = residentMemory() - memory;
    const double share = shareOf(painted, large());
    device_->takeTimes();
    rows_.push_back({.mode = mode,
                     .shots = count,
                     .range = range,
                     .painted = share,
                     .placeSeconds = std::max(took, 0.0) / 1000,
                     .raysAShot = static_cast<double>(place_.rays->count() - rays) / each,
                     .memory = grown,
                     .bytesAShot = grown * 1048576 / each,
                     .coarser = painted.report().coarser,
                     .givenUp = painted.report().givenUp});
  }

  const CommonOptions& options_;
  const uint32_t memory_;
  const Place& place_;
  const effect::Registry& registry_;
  std::unique_ptr<gpu::Device> device_;
  std::vector<std::unique_ptr<Painted>> painted_;
  std::vector<Row> rows_;
};

void print(const std::vector<Row>& rows) {
  fmt::print(
      "| mode | shots | range, m | painted | paint, ms | paint, first row = 1 | frame, ms | frame, "
      "first row = 1 | "
      "to place all, s | rays a shot | memory, MiB | bytes a shot | coarser | given up |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const Row& row : rows) {
    fmt::print(
        "| {} | {} | {:.2f} | {:.0f} % | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.0f} | "
        "{:.0f} "
        "| {:.0f} | {} | {} |\n",
        row.mode, row.shots, row.range, 100 * row.painted, median(row.effect),
        median(row.effectRatio), median(row.frame), median(row.frameRatio), row.placeSeconds,
        row.raysAShot, row.memory, row.bytesAShot, row.coarser, row.givenUp);
  }
}

}  // namespace

Place::Place(Subject theSubject, std::vector<size_t> theCounts,
             std::vector<size_t> thePerShotCounts, const std::vector<size_t>& extra)
    : subject(std::move(theSubject)),
      counts(std::move(theCounts)),
      perShotCounts(std::move(thePerShotCounts)),
      rays(std::make_unique<tests::TracedRays>(subject.scene)) {
  size_t most = 0;
  for (const size_t count : counts) most = std::max(most, count);
  for (const size_t count : perShotCounts) most = std::max(most, count);
  for (const size_t count : extra) most = std::max(most, count);
  shots = randomShots(subject, rays->tracer(), most);
}
void measureCost(const std::string& backend, const Place& place, const effect::Registry& registry,
                 const CommonOptions& options, uint32_t memory, std::vector<Curve>& curves) {
  if (place.counts.empty()) return;
  Bench bench(backend, place, registry, options, memory);
  const gpu::DeviceInfo& info = bench.info();
  fmt::print("## {}, {}: {}\n\nDriver: {}{}. Clock: {}.\n\n", place.subject.name, info.backend,
             info.name, info.driver, info.software ? " (software)" : "",
             gpu::clockName(info.clock));
  const std::vector<Row> rows = bench.run();
  print(rows);
  for (const char* mode : {"surface", "per_shot"}) {
    Curve curve{
        .title = fmt::format("{} on {} ({})", mode == std::string("surface") ? mode : "per shot",
                             place.subject.name, backend),
        .rows = {}};
    std::ranges::copy_if(rows, std::back_inserter(curve.rows),
                         [&](const Row& row) { return row.mode == mode && row.range == kRange; });
    if (!curve.rows.empty()) curves.push_back(std::move(curve));
  }
  const std::vector<double> more = bench.oneMore(101);
  fmt::print(
      "\nOne more shot at {} takes {:.2f} ms (median of {}; 9 of 10 at most {:.2f}, all at most "
      "{:.2f}).\n\n",
      place.counts.back(), more[more.size() / 2], more.size(), more[more.size() * 9 / 10],
      more.back());
  std::fflush(stdout);
}

void writePlot(const std::filesystem::path& folder, const std::vector<Curve>& curves) {
  std::filesystem::create_directories(folder);
  const std::filesystem::path csv = folder / "paint_cost.csv";
  std::ofstream file(csv);
  std::string plots;
  for (size_t i = 0; i < curves.size(); ++i) {
    if (i > 0) file << "\n\n";
    for (const Row& row : curves[i].rows) {
      const auto [least, most] = std::ranges::minmax(row.effect);
      file << fmt::format("{},{},{},{},{}\n", curves[i].title, row.shots, median(row.effect), least,
                          most);
    }
    plots += fmt::format("{}'{}' index {} using 2:3:4:5 with yerrorlines lw 2 title '{}'",
                         plots.empty() ? "" : ", ", csv.string(), i, curves[i].title);
  }
  file.close();
  const std::string script = fmt::format(
      "set datafile separator ','; set logscale xy; set grid; set key below; "
      "set xlabel 'shots'; set ylabel 'paint, ms a frame'; set colorsequence podo; "
      "set terminal svg size 900,450 background rgb 'white'; set output '{0}/paint_cost.svg'; "
      "plot {1}; set terminal pngcairo size 900,450; set output '{0}/paint_cost.png'; replot",
      folder.string(), plots);
  std::ofstream(folder / "paint_cost.gp") << script << "\n";
  const std::string command = fmt::format("gnuplot '{}'", (folder / "paint_cost.gp").string());
  if (std::system(command.c_str()) != 0) fmt::print(stderr, "no plot: gnuplot failed\n");
}

}  // namespace grisaille::bench
