// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "backends/vulkan/instance.h"
#include "tests/support/expect_error.h"

namespace grisaille::vulkan {
namespace {

Candidate candidate(const char* name, VkPhysicalDeviceType type, const char* lacks = "") {
  Candidate made;
  made.type = type;
  made.listed.name = name;
  made.lacks = lacks;
  return made;
}

std::vector<Candidate> several() {
  return {candidate("llvmpipe (LLVM)", VK_PHYSICAL_DEVICE_TYPE_CPU),
          candidate("Intel Arc", VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU),
          candidate("Old Radeon", VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU, "Vulkan 1.3"),
          candidate("GeForce", VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU),
          candidate("virtio", VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU)};
}

TEST(Choice, PrefersTheStrongestThatFits) {
  std::vector<Candidate> list = several();
  const std::string any;
  for (const char* expected : {"GeForce", "Intel Arc", "virtio", "llvmpipe (LLVM)"}) {
    const Candidate& chosen = choose(list, any);
    EXPECT_EQ(chosen.listed.name, expected);
    list.erase(list.begin() + (&chosen - list.data()));
  }
  EXPECT_ERROR(ErrorId::kDeviceTooOld, choose(list, ""));
  list.clear();
  EXPECT_ERROR(ErrorId::kNoDevice, choose(list, ""));
}

TEST(Choice, TakesANumberOrAPartOfTheName) {
  const std::vector<Candidate> list = several();
  EXPECT_EQ(&choose(list, "0"), &list[0]);
  EXPECT_EQ(&choose(list, "4"), &list[4]);
  EXPECT_EQ(&choose(list, "LLVM"), &list[0]);
  EXPECT_EQ(&choose(list, "geforce"), &list[3]);
  EXPECT_EQ(&choose(list, "INTEL a"), &list[1]);
}

TEST(Choice, RefusesWhatIsNotThere) {
  const std::vector<Candidate> list = several();
  for (const char* wanted : {"5", "-1", "99999999999999999999999", "matrox", "0x0"}) {
    EXPECT_ERROR(ErrorId::kNoDevice, choose(list, wanted));
  }
  EXPECT_ERROR(ErrorId::kDeviceTooOld, choose(list, "radeon"));
  EXPECT_ERROR(ErrorId::kDeviceTooOld, choose(list, "2"));
}

}  // namespace
}  // namespace grisaille::vulkan
