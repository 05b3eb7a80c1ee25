// SPDX-License-Identifier: MIT
// Checks of the arguments that a host passes.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "core/base/error.h"
#include "grisaille/host.h"

namespace grisaille::host {

// The pointee of `given`. Throws kHostNull if it is null.
template <typename T>
T& present(T* given, const char* name) {
  if (given == nullptr) throw Error(ErrorId::kHostNull, "{} is null", name);
  return *given;
}

// The sizes of a struct of host.h in earlier versions of the library, without the fields that were
// appended since.
template <typename Struct>
constexpr std::array<size_t, 0> kEarlierSizes = {};
template <>
constexpr inline std::array<size_t, 5> kEarlierSizes<grisaille_host_frame> = {
    offsetof(grisaille_host_frame, thickness), offsetof(grisaille_host_frame, next_depth),
    offsetof(grisaille_host_frame, patience), offsetof(grisaille_host_frame, colour),
    offsetof(grisaille_host_frame, rectangle)};
template <>
constexpr inline std::array<size_t, 1> kEarlierSizes<grisaille_host_report> = {
    offsetof(grisaille_host_report, coarser)};
template <>
constexpr inline std::array<size_t, 1> kEarlierSizes<grisaille_host_effect_desc> = {
    offsetof(grisaille_host_effect_desc, settings)};
template <>
constexpr inline std::array<size_t, 1> kEarlierSizes<grisaille_host_texture_desc> = {
    offsetof(grisaille_host_texture_desc, layers)};
template <>
constexpr inline std::array<size_t, 1> kEarlierSizes<grisaille_host_output> = {
    offsetof(grisaille_host_output, layers)};
template <>
constexpr inline std::array<size_t, 1> kEarlierSizes<grisaille_host_camera> = {
    offsetof(grisaille_host_camera, jitter)};
template <>
constexpr inline std::array<size_t, 2> kEarlierSizes<grisaille_host_vulkan> = {
    offsetof(grisaille_host_vulkan, pipeline_cache), offsetof(grisaille_host_vulkan, log)};
template <>
constexpr inline std::array<size_t, 2> kEarlierSizes<grisaille_host_opengl> = {
    offsetof(grisaille_host_opengl, frames_in_flight), offsetof(grisaille_host_opengl, log)};

// Checks a struct_size. `bytes`: the struct, whose bytes beyond `own` must be 0. Throws
// kHostStruct.
void checkStructSize(const void* bytes, uint32_t size, size_t own, std::span<const size_t> earlier,
                     const char* name);

// A copy of a struct that begins with its size. Fields that an earlier version lacks are 0. Throws
// kHostNull, and kHostStruct unless the size is that of a version, or larger with only zeros beyond
// the fields that this version knows.
template <typename Struct>
Struct whole(const Struct* given, const char* name) {
  const Struct& found = present(given, name);
  checkStructSize(&found, found.struct_size, sizeof(Struct), kEarlierSizes<Struct>, name);
  Struct copy = {};
  std::memcpy(&copy, &found, std::min<size_t>(found.struct_size, sizeof(Struct)));
  return copy;
}

// Throws kHostNull if `handle` is null.
void checkHandle(const void* handle, const char* name);

// Throws kHostValue unless value < count.
void checkEnum(uint32_t value, uint32_t count, const char* name);
// Throws kHostValue unless the point is within the limits of grisaille_point. `index`: its own.
void checkPoint(const grisaille_point& point, size_t index);
// Throws kHostValue if a field is out of range.
void checkPrepare(const grisaille_host_prepare& how);
// Throws kHostValue if `flags` has a bit that no grisaille_host_flags has.
void checkFlags(uint32_t flags, const char* name);
// Throws kHostValue unless value is 0.
void checkReserved(uint32_t value, const char* name);

}  // namespace grisaille::host
