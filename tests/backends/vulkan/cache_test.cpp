// SPDX-License-Identifier: MIT
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "shaders/both_ways_comp.h"
#include "tests/backends/vulkan/fixture.h"

namespace grisaille::vulkan {
namespace {

namespace fs = std::filesystem;

class Cache : public WithDevice {
 protected:
  void SetUp() override {
    WithDevice::SetUp();
    if (IsSkipped()) return;
    const char* old = std::getenv("XDG_CACHE_HOME");
    if (old != nullptr) old_ = old;
    folder_ = fs::temp_directory_path() / fmt::format("grisaille-cache-test-{}", getpid());
    fs::create_directories(folder_);
    setenv("XDG_CACHE_HOME", folder_.c_str(), 1);
  }
  void TearDown() override {
    if (old_.empty()) {
      unsetenv("XDG_CACHE_HOME");
    } else {
      setenv("XDG_CACHE_HOME", old_.c_str(), 1);
    }
    if (!folder_.empty()) fs::remove_all(folder_);
    WithDevice::TearDown();
  }

  // Opens a device, compiles a pipeline and closes the device, which writes the cache file.
  static void run() {
    const std::unique_ptr<gpu::Device> device = open(false);
    device->createComputePipeline({.label = "cached", .shader = &grisaille_shader_both_ways_comp});
  }

  std::vector<fs::path> files() const {
    std::vector<fs::path> list;
    const fs::path ours = folder_ / "grisaille";
    if (!fs::exists(ours)) return list;
    for (const fs::directory_entry& entry : fs::directory_iterator(ours)) list.push_back(entry);
    return list;
  }

  static std::string contents(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  static void replace(const fs::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary | std::ios::trunc) << text;
  }

  fs::path folder_;

 private:
  std::string old_;
};
GRISAILLE_ON_EVERY_VULKAN_DEVICE(Cache);

TEST_P(Cache, IsOneFileThatIsWrittenOnceAndLeftAlone) {
  run();
  ASSERT_EQ(files().size(), 1u);
  const fs::path file = files()[0];
  const auto longAgo = fs::file_time_type::clock::now() - std::chrono::hours(24);
  fs::last_write_time(file, longAgo);
  run();
  EXPECT_EQ(files().size(), 1u);
  EXPECT_EQ(fs::last_write_time(file), longAgo) << "unchanged contents were written again";
}

// No file grows from run to run, whatever the driver stores.
TEST_P(Cache, DoesNotGrow) {
  uintmax_t first = 0;
  for (int i = 0; i < 3; ++i) {
    run();
    uintmax_t bytes = 0;
    for (const fs::path& file : files()) bytes += fs::file_size(file);
    if (i == 0) first = bytes;
    EXPECT_EQ(bytes, first) << "run " << i;
  }
}

TEST_P(Cache, ADamagedFileIsReplaced) {
  run();
  ASSERT_EQ(files().size(), 1u);
  const fs::path file = files()[0];
  const std::string whole = contents(file);
  ASSERT_GT(whole.size(), 24u);
  std::vector<std::string> damaged = {"",
                                      "x",
                                      whole.substr(0, 24),
                                      whole + "x",
                                      whole.substr(0, whole.size() - 1),
                                      std::string(4096, '\xff')};
  for (size_t i = 0; i < whole.size(); ++i) {
    if (i % 3 != 0) continue;
    damaged.push_back(whole);
    damaged.back()[i] = static_cast<char>(damaged.back()[i] ^ 0x41);
  }
  for (const std::string& text : damaged) {
    replace(file, text);
    run();
    ASSERT_EQ(files().size(), 1u);
    ASSERT_EQ(contents(file), whole);
  }
}

TEST_P(Cache, AnUnusableFolderIsNoError) {
  replace(folder_ / "grisaille", "a file where the folder would be");
  EXPECT_NO_THROW(run());
  const fs::path blocked = folder_ / "blocked";
  replace(blocked, "");
  setenv("XDG_CACHE_HOME", blocked.c_str(), 1);
  EXPECT_NO_THROW(run());
}

}  // namespace
}  // namespace grisaille::vulkan
