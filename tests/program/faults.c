/* SPDX-License-Identifier: MIT
 * Preloaded into the program, makes system and driver calls fail. $FAULT selects how:
 *   disk_full      writes to files under $FAULT_FOLDER
 *   read_only      calls that create or change files there
 *   killed         the process ends by SIGKILL in the middle of such a write
 *   out_of_memory  the device has no memory left
 *   device_lost    the device is lost
 * The first $FAULT_AFTER such calls succeed (default 0). If $FAULT_WHEN names a file, calls fail
 * only once that file exists. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <epoxy/gl.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>
#include <vulkan/vulkan.h>

#define EXPORT __attribute__((visibility("default")))
#define NEXT(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

static atomic_int calls;

static int is(const char* fault) {
  const char* wanted = getenv("FAULT");
  return wanted != NULL && strcmp(wanted, fault) == 0;
}

/* Counts a call that may fail. Returns whether it fails. */
static int fails(void) {
  const char* after = getenv("FAULT_AFTER");
  const char* when = getenv("FAULT_WHEN");
  if (when != NULL && access(when, F_OK) != 0) return 0;
  return atomic_fetch_add(&calls, 1) >= (after != NULL ? atoi(after) : 0);
}

/* --- Files --- */

static int isUnder(const char* path) {
  const char* folder = getenv("FAULT_FOLDER");
  return folder != NULL && strncmp(path, folder, strlen(folder)) == 0;
}

/* Relative paths start at the working directory of the program. */
static int isPathUnder(const char* path) {
  char here[4096] = "", whole[8192];
  if (path[0] == '/') return isUnder(path);
  if (getcwd(here, sizeof here) == NULL) return 0;
  snprintf(whole, sizeof whole, "%s/%s", here, path);
  return isUnder(whole);
}

static int isFileUnder(int file) {
  char link[64], path[4096] = "";
  snprintf(link, sizeof link, "/proc/self/fd/%d", file);
  return readlink(link, path, sizeof path - 1) > 0 && isUnder(path);
}

static int refuses(const char* path) {
  if (!is("read_only") || !isPathUnder(path) || !fails()) return 0;
  errno = EROFS;
  return 1;
}

EXPORT FILE* fopen64(const char* path, const char* mode) {
  if (strpbrk(mode, "wa+") != NULL && refuses(path)) return NULL;
  return NEXT(fopen64)(path, mode);
}

static int changes(int flags) {
  return (flags & (O_WRONLY | O_RDWR | O_CREAT)) != 0;
}

static mode_t modeOf(int flags, va_list rest) {
  return (flags & O_CREAT) != 0 ? va_arg(rest, mode_t) : 0;
}

EXPORT int open(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = modeOf(flags, rest);
  va_end(rest);
  return changes(flags) && refuses(path) ? -1 : NEXT(open)(path, flags, mode);
}

EXPORT int open64(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = modeOf(flags, rest);
  va_end(rest);
  return changes(flags) && refuses(path) ? -1 : NEXT(open64)(path, flags, mode);
}

EXPORT int mkdir(const char* path, mode_t mode) {
  return refuses(path) ? -1 : NEXT(mkdir)(path, mode);
}

EXPORT int rename(const char* from, const char* to) {
  return refuses(to) ? -1 : NEXT(rename)(from, to);
}

/* Whether the write fails. For `killed`, writes half of the bytes and kills the process. */
static int failsToWrite(int file, const void* bytes, size_t count) {
  const int full = is("disk_full"), killed = is("killed");
  if ((!full && !killed) || !isFileUnder(file) || !fails()) return 0;
  if (killed) {
    if (NEXT(write)(file, bytes, count / 2) >= 0) raise(SIGKILL);
  }
  errno = ENOSPC;
  return 1;
}

EXPORT ssize_t write(int file, const void* bytes, size_t count) {
  return failsToWrite(file, bytes, count) ? -1 : NEXT(write)(file, bytes, count);
}

EXPORT ssize_t writev(int file, const struct iovec* parts, int count) {
  const struct iovec* last = &parts[count - 1];
  return failsToWrite(file, last->iov_base, last->iov_len) ? -1 : NEXT(writev)(file, parts, count);
}

/* --- Vulkan: dlopen returns this library, which forwards all other calls to the real one --- */

static void* vulkan;

static VKAPI_ATTR VkResult VKAPI_CALL outOfMemory(VkDevice device, const VkMemoryAllocateInfo* info,
                                                  const VkAllocationCallbacks* allocator,
                                                  VkDeviceMemory* memory);
static VKAPI_ATTR VkResult VKAPI_CALL lostAtSubmit(VkQueue queue, uint32_t count,
                                                   const VkSubmitInfo2* submits, VkFence fence);

static PFN_vkGetDeviceProcAddr nextOfDevice;
static PFN_vkAllocateMemory nextAllocate;
static PFN_vkQueueSubmit2 nextSubmit;

static VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL deviceFunction(VkDevice device, const char* name) {
  const PFN_vkVoidFunction next = nextOfDevice(device, name);
  if (strcmp(name, "vkAllocateMemory") == 0) {
    nextAllocate = (PFN_vkAllocateMemory)next;
    return (PFN_vkVoidFunction)outOfMemory;
  }
  if (strcmp(name, "vkQueueSubmit2") == 0) {
    nextSubmit = (PFN_vkQueueSubmit2)next;
    return (PFN_vkVoidFunction)lostAtSubmit;
  }
  return next;
}

EXPORT VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL vkGetInstanceProcAddr(VkInstance instance,
                                                                      const char* name) {
  const PFN_vkGetInstanceProcAddr get =
      (PFN_vkGetInstanceProcAddr)dlsym(vulkan, "vkGetInstanceProcAddr");
  const PFN_vkVoidFunction next = get(instance, name);
  if (next == NULL || strcmp(name, "vkGetDeviceProcAddr") != 0) return next;
  nextOfDevice = (PFN_vkGetDeviceProcAddr)next;
  return (PFN_vkVoidFunction)deviceFunction;
}

static VKAPI_ATTR VkResult VKAPI_CALL outOfMemory(VkDevice device, const VkMemoryAllocateInfo* info,
                                                  const VkAllocationCallbacks* allocator,
                                                  VkDeviceMemory* memory) {
  if (is("out_of_memory") && fails()) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
  return nextAllocate(device, info, allocator, memory);
}

static VKAPI_ATTR VkResult VKAPI_CALL lostAtSubmit(VkQueue queue, uint32_t count,
                                                   const VkSubmitInfo2* submits, VkFence fence) {
  if (is("device_lost") && fails()) return VK_ERROR_DEVICE_LOST;
  return nextSubmit(queue, count, submits, fence);
}

EXPORT void* dlopen(const char* name, int flags) {
  void* library = NEXT(dlopen)(name, flags);
  Dl_info self;
  if (library == NULL || name == NULL || strstr(name, "libvulkan.so") == NULL) return library;
  if ((!is("out_of_memory") && !is("device_lost")) || dladdr((void*)is, &self) == 0) return library;
  vulkan = library;
  return NEXT(dlopen)(self.dli_fname, RTLD_NOW | RTLD_LOCAL);
}

/* --- OpenGL: replaces epoxy's function pointers. The first call through a pointer resolves and
 * overwrites it, so each pointer is restored to epoxy's own during a call. --- */

static PFNGLTEXTURESTORAGE2DPROC nextStorage;
static PFNGLGETERRORPROC nextError;
static GLenum pending;

static void GLAPIENTRY storage(GLuint texture, GLsizei mips, GLenum format, GLsizei width,
                               GLsizei height) {
  if (fails()) {
    pending = GL_OUT_OF_MEMORY;
    return;
  }
  epoxy_glTextureStorage2D = nextStorage;
  glTextureStorage2D(texture, mips, format, width, height);
  nextStorage = epoxy_glTextureStorage2D;
  epoxy_glTextureStorage2D = storage;
}

static GLenum GLAPIENTRY error(void) {
  GLenum result = pending;
  pending = GL_NO_ERROR;
  if (result != GL_NO_ERROR) return result;
  epoxy_glGetError = nextError;
  result = glGetError();
  nextError = epoxy_glGetError;
  epoxy_glGetError = error;
  return result;
}

static GLenum GLAPIENTRY resetStatus(void) {
  return fails() ? GL_UNKNOWN_CONTEXT_RESET : GL_NO_ERROR;
}

__attribute__((constructor)) static void begin(void) {
  if (is("out_of_memory")) {
    nextStorage = epoxy_glTextureStorage2D;
    nextError = epoxy_glGetError;
    epoxy_glTextureStorage2D = storage;
    epoxy_glGetError = error;
  } else if (is("device_lost")) {
    epoxy_glGetGraphicsResetStatus = resetStatus;
  }
}
