// SPDX-License-Identifier: MIT
#include "app/video.h"

#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <thread>

#include "app/process/child.h"
#include "app/truth/interruption.h"
#include "core/base/error.h"

namespace grisaille::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kProgram = "ffmpeg";

bool isOnPath(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path file = fs::path(folder.empty() ? "." : folder) / program;
    std::error_code failed;
    if (fs::is_regular_file(file, failed) && access(file.c_str(), X_OK) == 0) return true;
  }
  return false;
}

// The last line that is not empty.
std::string lastLine(const std::string& text) {
  const size_t end = text.find_last_not_of("\r\n");
  if (end == std::string::npos) return "no message";
  const size_t before = text.find_last_of("\r\n", end);
  const size_t from = before == std::string::npos ? 0 : before + 1;
  return oneLine(text.substr(from, end + 1 - from));
}

// ffmpeg would take a name such as "-x.mp4" for an option, and "a:b.mp4" for a protocol.
std::string plainName(const std::string& path) {
  return "file:" + path;
}

}  // namespace

void requireVideo(const std::string& file) {
  if (!fs::path(file).has_extension()) {
    throw Error(ErrorId::kVideo, "the name of the video '{}' has no ending", file);
  }
  if (!isOnPath(kProgram)) {
    throw Error(ErrorId::kVideo, "'{}' needs the program ffmpeg, which $PATH does not have", file);
  }
}

void writeVideo(const VideoFrames& frames, const std::string& file) {
  const fs::path path(file);
  const fs::path part = path.parent_path() / fmt::format("{}.part-{}{}", path.stem().string(),
                                                         getpid(), path.extension().string());
  Child child({kProgram, "-nostdin", "-v", "error", "-y", "-framerate",
               fmt::format("{}", frames.rate), "-start_number", "0", "-i",
               plainName(frames.files.pattern()), "-frames:v", fmt::format("{}", frames.count),
               "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p",
               plainName(part.string())});
  while (child.running()) {
    if (truth::Interruption::asked()) child.end();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  std::error_code failed;
  const bool good = child.status() == 0 && !truth::Interruption::asked();
  if (good) fs::rename(part, path, failed);
  if (!good || failed) {
    std::error_code ignored;
    fs::remove(part, ignored);
  }
  if (truth::Interruption::asked()) throw truth::Interrupted();
  if (!good) throw Error(ErrorId::kVideo, "{}: ffmpeg fails: {}", file, lastLine(child.err()));
  if (failed) throw Error(ErrorId::kFileUnwritable, "{}: {}", file, failed.message());
}

}  // namespace grisaille::app
