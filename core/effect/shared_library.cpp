// SPDX-License-Identifier: MIT
#include "core/effect/shared_library.h"

#include <dlfcn.h>
#include <link.h>

#include <atomic>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <vector>

#include "core/base/error.h"
#include "core/base/regular_file.h"

namespace grisaille::effect {
namespace {

std::string loaderWords() {
  const char* words = dlerror();
  return words != nullptr ? words : "the loader gives no reason";
}

template <typename T>
bool read(std::ifstream& file, uint64_t offset, T* out, size_t count = 1) {
  file.seekg(static_cast<std::streamoff>(offset));
  file.read(reinterpret_cast<char*>(out), static_cast<std::streamsize>(count * sizeof(T)));
  return file.good();
}

// Whether the file ends before a segment that its headers tell the loader to map. The loader does
// not check this: an access to the missing part would crash the program (SIGBUS). Returns false for
// files that are not ELF files of this machine's word size; the loader refuses them.
bool isCutShort(const std::string& path, uint64_t bytes) {
  std::ifstream file(path, std::ios::binary);
  ElfW(Ehdr) header;
  if (!read(file, 0, &header)) return false;
  constexpr unsigned char kClass = sizeof(void*) == 8 ? ELFCLASS64 : ELFCLASS32;
  if (std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0) return false;
  if (header.e_ident[EI_CLASS] != kClass || header.e_phentsize != sizeof(ElfW(Phdr))) return false;
  std::vector<ElfW(Phdr)> segments(header.e_phnum);
  if (!read(file, header.e_phoff, segments.data(), segments.size())) return true;
  for (const ElfW(Phdr) & segment : segments) {
    if (segment.p_offset > bytes || segment.p_filesz > bytes - segment.p_offset) return true;
  }
  return false;
}

// Another name of the same file, which this process has not loaded yet. For a known name, the
// loader returns the loaded library even if the file has changed since. It still recognises an
// unchanged file by its inode number.
std::string freshName(const std::string& path) {
  static std::atomic<size_t> opened = 0;
  constexpr size_t kNames = 256;
  const std::filesystem::path whole(path);
  std::string folder = whole.parent_path().string() + "/";
  for (size_t i = opened++ % kNames; i > 0; --i) folder += "./";
  return folder + whole.filename().string();
}

}  // namespace

void CloseLibrary::operator()(void* library) const {
  dlclose(library);
}

Library openLibrary(const std::string& path) {
  std::error_code failed;
  const std::string why = whyNotRegular(path);
  if (!why.empty()) throw Error(ErrorId::kPluginUnloadable, "{}", why);
  const uint64_t bytes = std::filesystem::file_size(path, failed);
  if (failed) throw Error(ErrorId::kPluginUnloadable, "{}", failed.message());
  if (isCutShort(path, bytes)) {
    throw Error(ErrorId::kPluginUnloadable, "it ends after {} bytes, before its last segment",
                bytes);
  }
  Library library(dlopen(freshName(path).c_str(), RTLD_NOW | RTLD_LOCAL));
  if (!library) throw Error(ErrorId::kPluginUnloadable, "{}", loaderWords());
  return library;
}

const void* symbolOf(const Library& library, const char* name) {
  const void* symbol = dlsym(library.get(), name);
  if (symbol == nullptr) throw Error(ErrorId::kPluginSymbol, "{}", loaderWords());
  return symbol;
}

}  // namespace grisaille::effect
