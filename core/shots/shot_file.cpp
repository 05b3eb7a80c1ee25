// SPDX-License-Identifier: MIT
#include "core/shots/shot_file.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/base/atomic_file.h"
#include "core/base/error.h"
#include "core/base/regular_file.h"
#include "core/shots/formats.h"
#include "core/shots/shot.h"

namespace grisaille::shots {
namespace {

using Writer = void (*)(std::span<const grisaille_shot>, std::ostream&);

Writer writerOf(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  if (ending == ".json") return writeJson;
  if (ending == ".shots") return writeBinary;
  throw Error(ErrorId::kShotFileEnding, "{}: the ending \"{}\" names no format of shots", path,
              ending);
}

}  // namespace

void checkEnding(const std::string& path) {
  writerOf(path);
}

void save(std::span<const grisaille_shot> shots, const std::string& path) {
  const Writer write = writerOf(path);
  const std::vector<grisaille_shot> sound = checked(shots);
  std::ostringstream text;
  write(sound, text);
  writeFileAtomically(path, text.view());
}

std::vector<grisaille_shot> load(const std::string& path) {
  std::ifstream file = openRegularFile(path, ErrorId::kShotFileUnreadable);
  std::error_code code;
  const uintmax_t bytes = std::filesystem::file_size(path, code);
  if (code) throw Error(ErrorId::kShotFileUnreadable, "{}: {}", path, code.message());
  try {
    return file.peek() == kBinaryMark ? readBinary(file, bytes) : readJson(file);
  } catch (const Error& error) {
    throw Error(error.id(), "{}:{}", path, error.detail());
  }
}

}  // namespace grisaille::shots
