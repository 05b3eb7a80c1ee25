// SPDX-License-Identifier: MIT
#include "core/base/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <optional>
#include <utility>

#include "core/base/error.h"

namespace grisaille {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
  throw Error(ErrorId::kFileUnwritable, "{}: {}", path, why);
}

[[noreturn]] void refuse(const std::string& path, int number) {
  refuse(path, std::strerror(number));
}

// An open file of this process.
class File {
 public:
  File(const std::string& path, int flags, mode_t mode = 0)
      : number_(open(path.c_str(), flags | O_CLOEXEC | O_NOCTTY, mode)) {}
  ~File() {
    if (number_ >= 0) ::close(number_);
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  bool isOpen() const { return number_ >= 0; }
  int number() const { return number_; }
  // False if the file system reports only now that a write failed.
  bool close() { return ::close(std::exchange(number_, -1)) == 0; }

 private:
  int number_;
};

// On failure returns false and sets errno.
bool writeAll(int file, std::string_view content) {
  while (!content.empty()) {
    const ssize_t count = ::write(file, content.data(), content.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return false;
    content.remove_prefix(static_cast<size_t>(count));
  }
  return true;
}

// Status of the file that `path` leads to; nullopt if it does not exist.
std::optional<struct stat> statusOf(const std::string& path) {
  struct stat status = {};
  if (stat(path.c_str(), &status) == 0) return status;
  return std::nullopt;
}

// Standard output or standard error if it is redirected to this file, else -1.
int streamOf(const struct stat& status) {
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) {
    struct stat own = {};
    if (fstat(stream, &own) == 0 && own.st_dev == status.st_dev && own.st_ino == status.st_ino) {
      return stream;
    }
  }
  return -1;
}

// `path`, or the file that its links lead to, which need not exist.
fs::path followed(const std::string& path) {
  constexpr int kMostLinks = 40;  // same limit as Linux
  fs::path target = path;
  std::error_code failed;
  for (int links = 0; fs::is_symlink(target, failed); ++links) {
    if (links == kMostLinks) refuse(path, ELOOP);
    const fs::path next = fs::read_symlink(target, failed);
    if (failed) refuse(path, failed.message());
    target = target.parent_path() / next;  // `next` itself if it is absolute
  }
  return target;
}

std::string partOf(const std::string& target) {
  return fmt::format("{}.{}.part", target, getpid());
}

// Gives the temporary file the owner, group and permission bits of the file that it replaces. If
// the owner or the group cannot be kept, drops the special bits; if the group cannot be kept, gives
// the new group only the permissions of others.
void takeOver(int part, const struct stat& old) {
  constexpr auto kSame = static_cast<uid_t>(-1);
  struct stat own = {};
  if (fstat(part, &own) != 0 || !S_ISREG(own.st_mode)) return;
  const bool all = (own.st_uid == old.st_uid && own.st_gid == old.st_gid) ||
                   fchown(part, old.st_uid, old.st_gid) == 0;
  const bool group = all || own.st_gid == old.st_gid || fchown(part, kSame, old.st_gid) == 0;
  mode_t bits = old.st_mode & (all ? 07777 : 0777);
  if (!group) bits = (bits & 0707) | (bits & 07) << 3;
  if (fchmod(part, bits) != 0) return;  // a file system without permissions
}

void writePart(const std::string& path, const std::string& part, const struct stat* old,
               std::string_view content) {
  constexpr mode_t kNew = 0666;
  File file(part, O_WRONLY | O_CREAT | O_TRUNC, old != nullptr ? old->st_mode & kNew : kNew);
  if (!file.isOpen()) refuse(path, errno);
  if (!writeAll(file.number(), content)) refuse(path, errno);
  if (old != nullptr) takeOver(file.number(), *old);
  if (!file.close()) refuse(path, errno);
}

void replace(const std::string& path, const struct stat* old, std::string_view content) {
  const std::string target = followed(path).string();
  const std::string part = partOf(target);
  std::error_code failed;
  try {
    writePart(path, part, old, content);
    fs::rename(part, target, failed);
    if (failed) refuse(path, failed.message());
  } catch (...) {
    fs::remove(part, failed);
    throw;
  }
}

// Writes into an existing file without replacing it.
void writeInto(const std::string& path, std::string_view content) {
  File file(path, O_WRONLY);
  if (!file.isOpen()) refuse(path, errno);
  if (!writeAll(file.number(), content)) refuse(path, errno);
  if (!file.close()) refuse(path, errno);
}

}  // namespace

void writeFileAtomically(const std::string& path, std::string_view content) {
  const std::optional<struct stat> there = statusOf(path);
  if (there && S_ISDIR(there->st_mode)) refuse(path, "is a folder");
  const int stream = there ? streamOf(*there) : -1;
  if (stream >= 0 && !S_ISCHR(there->st_mode)) {
    std::fflush(stream == STDOUT_FILENO ? stdout : stderr);
    if (!writeAll(stream, content)) refuse(path, errno);
  } else if (there && !S_ISREG(there->st_mode)) {
    writeInto(path, content);
  } else {
    replace(path, there ? &*there : nullptr, content);
  }
}

void requireWritable(const std::string& path) {
  if (const auto there = statusOf(path)) {
    if (S_ISDIR(there->st_mode)) refuse(path, "is a folder");
    if (streamOf(*there) >= 0) return;
    if (!S_ISREG(there->st_mode)) {
      if (access(path.c_str(), W_OK) != 0) refuse(path, errno);
      return;
    }
  }
  const std::string part = partOf(followed(path).string());
  const bool opened = File(part, O_WRONLY | O_CREAT | O_TRUNC, 0600).isOpen();
  const int why = errno;
  std::error_code failed;
  fs::remove(part, failed);
  if (!opened) refuse(path, why);
}

void requireWritableFolder(const std::string& folder) {
  std::error_code code;
  const bool made = fs::create_directories(folder, code);
  if (code) refuse(folder, code.message());
  requireWritable((fs::path(folder) / "grisaille").string());
  // Only a check: do not leave an empty folder behind.
  if (made) fs::remove(folder, code);
}

fs::path targetOf(const std::string& path) {
  const fs::path target = followed(path);
  std::error_code failed;
  const fs::path whole = fs::weakly_canonical(fs::absolute(target, failed), failed);
  return failed ? target.lexically_normal() : whole;
}

}  // namespace grisaille
