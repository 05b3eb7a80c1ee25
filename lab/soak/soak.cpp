// SPDX-License-Identifier: MIT
#include "lab/soak/soak.h"

#include <fmt/format.h>
#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <random>
#include <utility>

#include "app/services/scene_services.h"
#include "app/settings/load_effects.h"
#include "app/truth/interruption.h"
#include "app/truth/progress.h"
#include "core/effect/chain.h"
#include "core/frame/renderer.h"
#include "core/objects/object_file.h"
#include "lab/paint/shot.h"

namespace grisaille::lab::soak {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr double kReach = 1;  // of the camera from its eye, metres
// Seconds a frame for placing shots: of a spray; and of all shots anew, as in the viewer.
constexpr double kSprayPatience = 0.004, kAnewPatience = 0.03;
constexpr double kLimit = 2;                      // a quiet frame takes at most so many medians,
constexpr double kViewLimit = 1.25;               // or so many times its view without new shots
constexpr double kAgainFrom = 1.5;                // medians after which that view is drawn again
constexpr size_t kLeastFrames = 10;               // quiet ones of a size, for a median
constexpr double kGrowth = 0.05, kGrowthMiB = 8;  // of memory after the limit

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Seconds that all threads of this process have worked.
double processorSeconds() {
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

// Resident memory of this process, MiB. On a software driver it includes the device's memory.
double residentMemory() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("VmRSS:")) return std::stod(line.substr(6)) / 1024;
  }
  return 0;
}

double quantile(std::vector<double> values, double share) {
  std::ranges::sort(values);
  return values[static_cast<size_t>(share * static_cast<double>(values.size() - 1))];
}

const char* nameOf(Kind kind) {
  constexpr const char* kNames[kKinds] = {"quiet", "places shots anew", "reload", "resize"};
  return kNames[static_cast<size_t>(kind)];
}

class Soak {
 public:
  Soak(const Plan& plan, const scene::Scene& scene, const scene::Camera& camera,
       gpu::Device& device)
      : plan_(plan),
        start_(camera),
        device_(device),
        random_(plan.seed),
        due_(schedule(plan)),
        sizes_(sizesOf(plan)),
        services_(scene),
        registry_(app::loadEffects({})),
        chain_(effect::Selection(*registry_, std::array<std::string, 2>{"ssao", "sspm"})),
        started_(chain_, device),
        renderer_(device, scene) {
    chain_.selection.values("sspm").set("memory", fmt::format("{}", plan.memory));
    services_.rays().prepare();
    services_.rays().wait();
    outcome_.software = device.info().software;
    fire(plan.before, start_);
    do {
      render(0, std::numeric_limits<double>::infinity());
    } while (renderer_.report().waiting > 0);
    for (size_ = sizes_.size(); size_-- > 0;) render(0, kAnewPatience);  // memory of every size
    size_ = 0;
    begin_ = Clock::now();
  }
  ~Soak() {
    std::error_code failed;
    fs::remove(file_, failed);
  }

  Outcome run() {
    const double end = 60 * plan_.minutes;
    app::truth::Progress progress("soak", app::truth::usualProgress());
    double now = 0;
    while (now < end) {
      if (app::truth::Interruption::asked()) throw app::truth::Interrupted();
      const Kind kind = advance(now);
      draw(now, kind);
      if (outcome_.samples.empty() || now >= outcome_.samples.back().second + 1) sample(now);
      progress.show({now, end, fmt::format("{} shots", list().size())});
      now = secondsSince(begin_);
    }
    return std::move(outcome_);
  }

 private:
  objects::ObjectList& list() { return *chain_.objects("sspm"); }

  // Does what is due, and fires the shots that are due. Returns the kind of the next frame.
  Kind advance(double now) {
    Kind kind = Kind::kQuiet;
    for (; next_ < due_.size() && due_[next_].second <= now; ++next_) {
      kind = std::max(kind, perform(due_[next_]));
      ++outcome_.events[static_cast<size_t>(due_[next_].event)];
    }
    const double share = std::min(1.0, now / (60 * plan_.minutes));
    const auto wanted = static_cast<size_t>(static_cast<double>(plan_.shots) * share);
    if (!holding_) {
      fire(wanted - outcome_.fired, cameraAt(start_, now, kReach));
      outcome_.fired = wanted;
    }
    return std::max(kind, placing_ ? Kind::kPlaces : Kind::kQuiet);
  }

  Kind perform(const Due& due) {
    switch (due.event) {
      case Event::kUndo: {
        const size_t shots = list().size();
        for (undone_ = 0; list().canUndo() && list().size() + due.amount > shots; ++undone_) {
          list().undo();
        }
        holding_ = due.again;
        placing_ = true;
        return Kind::kPlaces;
      }
      case Event::kRedo:
        for (; undone_ > 0; --undone_) list().redo();
        holding_ = false;
        placing_ = true;
        return Kind::kPlaces;
      case Event::kSaveObjects:
        objects::save(list().view(), file_);
        return Kind::kQuiet;
      case Event::kLoadObjects:
        list().assign(objects::load(list().table(), file_));
        undone_ = 0;
        placing_ = true;
        return Kind::kReload;
      case Event::kReloadEffects: {
        auto fresh = app::loadEffects({});
        device_.wait();
        chain_.rebind(*fresh);
        registry_ = std::move(fresh);
        placing_ = true;
        return Kind::kReload;
      }
      default:
        size_ = due.amount;
        return Kind::kResize;
    }
  }

  // Shots from about the camera, as a player sprays them.
  void fire(size_t count, const scene::Camera& camera) {
    const glm::dmat3 axes = scene::worldFromView(camera);
    std::uniform_real_distribution<double> unit(-1, 1);
    std::uniform_real_distribution<float> channel(0, 1);
    std::vector<Shot> shots(count);
    for (Shot& shot : shots) {
      const glm::dvec3 eye =
          camera.eye + 0.2 * (axes * glm::dvec3(unit(random_), unit(random_), 0));
      const glm::vec3 to(glm::normalize(axes * glm::dvec3(unit(random_), 0.6 * unit(random_), -1)));
      shot = {.origin = {eye.x, eye.y, eye.z},
              .direction = {to.x, to.y, to.z},
              .color = {channel(random_), channel(random_), channel(random_)},
              .range = 0};
    }
    list().add(objectsOf(list().table(), shots));
  }

  void render(double now, double patience) {
    renderer_.render({.camera = cameraAt(start_, now, kReach),
                      .width = sizes_[size_].x,
                      .height = sizes_[size_].y,
                      .chain = &chain_,
                      .outputs = outputs_,
                      .patience = patience,
                      .services = services_.all()});
    device_.wait();
  }

  Frame timed(double now, Kind kind) {
    const double processor = processorSeconds();
    const Clock::time_point start = Clock::now();
    render(now, placing_ ? kAnewPatience : kSprayPatience);
    return {.kind = kind,
            .second = now,
            .size = sizes_[size_],
            .wall = 1000 * secondsSince(start),
            .processor = 1000 * (processorSeconds() - processor)};
  }

  void draw(double now, Kind kind) {
    outcome_.frames.push_back(timed(now, kind));
    placing_ = placing_ && renderer_.report().waiting > 0;
    const Frame& frame = outcome_.frames.back();
    if (kind != Kind::kQuiet) return;
    const double took = judged(outcome_, frame);
    std::vector<double>& same = quiet_[size_];
    same.push_back(took);
    if (same.size() < kLeastFrames || took <= kAgainFrom * quantile(same, 0.5)) return;
    // Tells whether the view takes long, or what was new in it.
    outcome_.frames.back().again = judged(outcome_, timed(now, kind));
  }

  void sample(double now) {
    malloc_trim(0);  // the allocator keeps freed memory, more or less of it by chance
    outcome_.samples.push_back({.second = now,
                                .shots = list().size(),
                                .memory = residentMemory(),
                                .resources = chain_.resources(),
                                .givenUp = renderer_.report().givenUp});
  }

  const Plan plan_;
  const scene::Camera start_;
  gpu::Device& device_;
  std::mt19937 random_;
  const std::vector<Due> due_;
  size_t next_ = 0;  // index of the next event
  const std::vector<glm::uvec2> sizes_;
  size_t size_ = 0;
  std::map<size_t, std::vector<double>> quiet_;  // by size: what quiet frames took, ms
  const std::string file_ =
      (fs::temp_directory_path() / fmt::format("grisaille-soak-{}.json", getpid())).string();
  const std::vector<std::string> outputs_ = {"color"};
  app::SceneServices services_;
  std::unique_ptr<effect::Registry> registry_;
  effect::Chain chain_;
  effect::StartedChain started_;
  frame::Renderer renderer_;
  size_t undone_ = 0;     // steps that the next kRedo does again
  bool holding_ = false;  // no shot is fired until that
  bool placing_ = false;  // shots are placed anew
  Outcome outcome_;
  Clock::time_point begin_;
};

// Width and height of the picture.
using Size = std::pair<uint32_t, uint32_t>;

// Medians of what quiet frames took, ms, of the sizes that have enough of them.
std::map<Size, double> mediansOf(const Outcome& outcome) {
  std::map<Size, std::vector<double>> quiet;
  for (const Frame& frame : outcome.frames) {
    if (frame.kind != Kind::kQuiet) continue;
    quiet[{frame.size.x, frame.size.y}].push_back(judged(outcome, frame));
  }
  std::map<Size, double> medians;
  for (const auto& [size, took] : quiet) {
    if (took.size() >= kLeastFrames) medians[size] = quantile(took, 0.5);
  }
  return medians;
}

// A quiet frame that takes over kLimit medians of its size.
struct LongFrame {
  const Frame* frame;
  double took;    // judged(), ms
  double median;  // of its size, ms
  bool isOfView() const { return frame->again > 0 && took <= kViewLimit * frame->again; }
};

std::vector<LongFrame> longFrames(const Outcome& outcome) {
  const std::map<Size, double> medians = mediansOf(outcome);
  std::vector<LongFrame> all;
  for (const Frame& frame : outcome.frames) {
    const auto median = medians.find({frame.size.x, frame.size.y});
    if (frame.kind != Kind::kQuiet || median == medians.end()) continue;
    const double took = judged(outcome, frame);
    if (took > kLimit * median->second) all.push_back({&frame, took, median->second});
  }
  return all;
}

void judgeFrames(const Outcome& outcome, std::vector<std::string>& faults) {
  if (mediansOf(outcome).empty()) {
    faults.push_back(fmt::format("no size has {} frames that place no shots anew", kLeastFrames));
  }
  for (const LongFrame& one : longFrames(outcome)) {
    if (one.isOfView()) continue;
    const Frame& frame = *one.frame;
    faults.push_back(fmt::format(
        "the frame at {:.2f} s takes {:.1f} ms, {:.2f} times the median of "
        "{}x{}{}",
        frame.second, one.took, one.took / one.median, frame.size.x, frame.size.y,
        frame.again > 0 ? fmt::format("; once more without new shots: {:.1f} ms", frame.again)
                        : ""));
  }
}

// Names the frames that take long because of what the camera sees.
std::string longViewsOf(const Outcome& outcome) {
  std::string text;
  size_t count = 0;
  double longest = 0, share = 0;
  for (const LongFrame& one : longFrames(outcome)) {
    if (!one.isOfView()) continue;
    ++count;
    longest = std::max(longest, one.took / one.median);
    share = std::max(share, one.took / one.frame->again);
    text += fmt::format("{}{:.2f}", text.empty() ? "" : ", ", one.frame->second);
  }
  return fmt::format(
      "over twice the median because of the view: {}; at most {:.2f} medians, {:.2f} times the "
      "view without new shots{}\n",
      count, longest, share, text.empty() ? "" : "; at second " + text);
}

// Memory in MiB from when the limit is reached: the medians of the first and the last third.
std::pair<double, double> memoryAtLimit(const Outcome& outcome) {
  const auto reached =
      std::ranges::find_if(outcome.samples, [](const Sample& one) { return one.givenUp > 0; });
  std::vector<double> all;
  for (auto it = reached; it != outcome.samples.end(); ++it) all.push_back(it->memory);
  if (all.size() < 3) return {0, 0};
  const auto third = static_cast<std::ptrdiff_t>(all.size() / 3);
  return {quantile({all.begin(), all.begin() + third}, 0.5),
          quantile({all.end() - third, all.end()}, 0.5)};
}

void judgeMemory(const Outcome& outcome, std::vector<std::string>& faults) {
  const auto [first, last] = memoryAtLimit(outcome);
  if (last == 0) {
    faults.push_back(
        "the effect's limit of memory is not reached; fire more --shots or lower it "
        "with --memory");
  } else if (last > first * (1 + kGrowth) + kGrowthMiB) {
    faults.push_back(
        fmt::format("memory grows from {:.0f} to {:.0f} MiB after the limit", first, last));
  }
}

}  // namespace

Outcome run(const Plan& plan, const scene::Scene& scene, const scene::Camera& camera,
            gpu::Device& device) {
  return Soak(plan, scene, camera, device).run();
}

double judged(const Outcome& outcome, const Frame& frame) {
  return outcome.software ? frame.processor : frame.wall;
}

std::vector<std::string> faultsOf(const Outcome& outcome) {
  std::vector<std::string> faults;
  judgeFrames(outcome, faults);
  judgeMemory(outcome, faults);
  return faults;
}

std::string tableOf(const Outcome& outcome) {
  std::string text = fmt::format(
      "| frames | size | count | median, ms | 99 %, ms | longest, ms | median of the {}, ms | "
      "longest of the {}, ms |\n|---|---|---|---|---|---|---|---|\n",
      "processor", "processor");
  std::map<std::tuple<size_t, uint32_t, uint32_t>,
           std::pair<std::vector<double>, std::vector<double>>>
      rows;
  for (const Frame& frame : outcome.frames) {
    auto& [wall, processor] = rows[{static_cast<size_t>(frame.kind), frame.size.x, frame.size.y}];
    wall.push_back(frame.wall);
    processor.push_back(frame.processor);
  }
  for (const auto& [key, row] : rows) {
    const auto& [kind, width, height] = key;
    const auto& [wall, processor] = row;
    text += fmt::format("| {} | {}x{} | {} | {:.1f} | {:.1f} | {:.1f} | {:.1f} | {:.1f} |\n",
                        nameOf(static_cast<Kind>(kind)), width, height, wall.size(),
                        quantile(wall, 0.5), quantile(wall, 0.99), quantile(wall, 1),
                        quantile(processor, 0.5), quantile(processor, 1));
  }
  text += "\n| second | shots | given up | memory, MiB | resources |\n|---|---|---|---|---|\n";
  const size_t step = std::max<size_t>(1, (outcome.samples.size() + 11) / 12);
  for (size_t i = 0; i < outcome.samples.size(); i += step) {
    const Sample& one = outcome.samples[i];
    text += fmt::format("| {:.0f} | {} | {} | {:.0f} | {} |\n", one.second, one.shots, one.givenUp,
                        one.memory, one.resources);
  }
  const auto [first, last] = memoryAtLimit(outcome);
  const auto count = [&](Event event) { return outcome.events[static_cast<size_t>(event)]; };
  return text + fmt::format(
                    "\nfired {}, undo {}, redo {}, objects loaded {}, effects reloaded {}, "
                    "resized {}\nmemory at the limit: {:.0f} MiB at first, {:.0f} at last\n{}",
                    outcome.fired, count(Event::kUndo), count(Event::kRedo),
                    count(Event::kLoadObjects), count(Event::kReloadEffects), count(Event::kResize),
                    first, last, longViewsOf(outcome));
}

}  // namespace grisaille::lab::soak
