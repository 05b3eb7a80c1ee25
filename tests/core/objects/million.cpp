// SPDX-License-Identifier: MIT
// Prints the time and memory that a million objects cost. Their table has a point, a direction, a
// colour and a number, like the longest lists of the program's own effects.
//
//   test_objects_million FILE.json
#include <sys/resource.h>

#include <chrono>
#include <filesystem>

#include "core/base/error.h"
#include "core/objects/object_file.h"
#include "core/objects/object_list.h"
#include "tests/core/objects/random_objects.h"

namespace grisaille::objects {
namespace {

constexpr size_t kCount = 1'000'000;

std::vector<Decal> decals() {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> metres(-50, 50);
  std::uniform_real_distribution<float> share(0, 1);
  std::vector<Decal> all(kCount);
  for (Decal& decal : all) {
    for (double& x : decal.position) x = metres(random);
    for (float& x : decal.direction) x = share(random) - 0.5f;
    for (float& x : decal.colour) x = share(random);
    decal.size = share(random);
  }
  return all;
}

class Stopwatch {
 public:
  void note(const char* what) {
    const std::chrono::duration<double> time = Clock::now() - last_;
    rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    const double processor = seconds(usage.ru_utime) + seconds(usage.ru_stime);
    fmt::print("{:<7} {:5.2f} s, of which a processor worked {:5.2f} s; at most {} MiB so far\n",
               what, time.count(), processor - processor_, usage.ru_maxrss / 1024);
    last_ = Clock::now();
    processor_ = processor;
  }

 private:
  using Clock = std::chrono::steady_clock;

  static double seconds(const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  }

  Clock::time_point last_ = Clock::now();
  double processor_ = 0;
};

void measure(const std::string& path) {
  Stopwatch stopwatch;
  ObjectList list(kPlainDecals);
  {
    const std::vector<Decal> given = decals();
    stopwatch.note("make");
    list.assign({&kPlainDecals, reinterpret_cast<const std::byte*>(given.data()), kCount});
    stopwatch.note("assign");
  }
  save(list.view(), path);
  stopwatch.note("save");
  Objects loaded = load(kPlainDecals, path);
  stopwatch.note("load");
  ObjectList again(kPlainDecals);
  again.add(std::move(loaded));
  stopwatch.note("add");
  fmt::print("file    {} MiB\n", std::filesystem::file_size(path) >> 20);
  if (!sameObjects(again.view(), list.view())) fmt::print("the objects are not the same\n");
}

}  // namespace
}  // namespace grisaille::objects

int main(int count, char** words) {
  if (count != 2) return 2;
  grisaille::objects::measure(words[1]);
}
