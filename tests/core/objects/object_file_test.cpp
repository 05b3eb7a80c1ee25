// SPDX-License-Identifier: MIT
#include "core/objects/object_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <nlohmann/json.hpp>

#include "core/objects/object_list.h"
#include "tests/core/objects/random_objects.h"
#include "tests/support/expect_error.h"
#include "tests/support/folder_test.h"

namespace grisaille::objects {
namespace {

namespace fs = std::filesystem;

class ObjectFiles : public tests::FolderTest {};

TEST_F(ObjectFiles, EveryBitComesBack) {
  for (const char* name : {"a.json", "A.JSON"}) {
    for (const size_t count : {0, 1, 2, 37, 5000}) {
      std::mt19937_64 random(count);
      const Objects objects = randomObjects(random, count);
      save(objects.view(), file(name));
      EXPECT_TRUE(sameObjects(load(kDecals, file(name)).view(), objects.view()))
          << name << " of " << count;
    }
  }
  EXPECT_EQ(filesInFolder(), 2u);
}

// Floats whose shortest decimal digits do not parse back to them through a double, and their
// neighbours.
TEST_F(ObjectFiles, HardFloatsComeBack) {
  std::vector<Decal> decals;
  for (uint32_t bits = 0x15ae43fd - 100; bits < 0x15ae43fd + 100; ++bits) {
    Decal decal = {{0, 0, 0}, {1, 0, 0}, {0, 0, 0}, 1, "", ""};
    std::memcpy(&decal.colour[0], &bits, sizeof bits);
    std::memcpy(&decal.direction[1], &bits, sizeof bits);
    decals.push_back(decal);
  }
  Objects objects(kDecals);
  objects.append(View{&kDecals, reinterpret_cast<const std::byte*>(decals.data()), decals.size()});
  save(objects.view(), file("a.json"));
  EXPECT_TRUE(sameObjects(load(kDecals, file("a.json")).view(), objects.view()));
}

TEST_F(ObjectFiles, JsonIsAsDescribed) {
  Objects objects(kDecals);
  Object object(kDecals);
  object.values[kPosition].numbers = {0.1, -2, 3e8};
  object.values[kDirection].numbers = {0, 3, 0};
  objects.append(object);
  object.values[kColour].numbers = {0.1, 1, 0};
  object.values[kSize].numbers[0] = 0.3;
  object.values[kNote].text = "\"\xc3\xa9\\";
  object.values[kPicture].text = "moss.png";
  objects.append(object);
  save(objects.view(), file("a.json"));
  const auto written = nlohmann::json::parse(contentOf(file("a.json")));
  const auto expected = nlohmann::json::parse(R"({"version": 1, "decals": [
    {"position": [0.1, -2, 3e8], "direction": [0, 1, 0]},
    {"position": [0.1, -2, 3e8], "direction": [0, 1, 0], "colour": [0.1, 1, 0], "size": 0.3,
     "note": "\"\u00e9\\", "picture": "moss.png"}]})");
  EXPECT_EQ(written, expected);
  EXPECT_EQ(contentOf(file("a.json")), jsonOf(objects.view()));
}

TEST_F(ObjectFiles, HandWrittenJsonIsRead) {
  const Objects objects = load(kDecals, fileOf("a.json", R"({
    "decals": [{"colour": [0, 1, 1e-1], "size": 0, "direction": [0, 0, -1e300],
                "position": [10000000000e-1, -0.0, 5], "note": "a\u00e9\/"},
               {"position": [0, 0, 0], "direction": [3, 0, 4e0]}],
    "version": 1.0})"));
  ASSERT_EQ(objects.size(), 2u);
  const Object first = objects.view().object(0), second = objects.view().object(1);
  EXPECT_EQ(first.values[kPosition].numbers, (std::array<double, 3>{1e9, 0, 5}));
  EXPECT_FALSE(std::signbit(first.values[kPosition].numbers[1]));
  EXPECT_EQ(first.values[kDirection].numbers, (std::array<double, 3>{0, 0, -1}));
  EXPECT_EQ(first.values[kColour].numbers, (std::array<double, 3>{0, 1, 0.1f}));
  EXPECT_EQ(first.values[kNote].text, "a\xc3\xa9/");
  EXPECT_EQ(second.values[kDirection].numbers[0], 0.6f);
  for (const size_t field : {kColour, kSize, kNote, kPicture}) {
    Objects expected(kDecals);
    expected.append(Object(kDecals));
    EXPECT_EQ(second.values[field], expected.view().value(0, kDecalFields[field])) << field;
  }
  const std::string bom = "\xEF\xBB\xBF{\"version\":1,\"decals\":[]}\n";
  EXPECT_EQ(load(kDecals, fileOf("b.json", bom)).size(), 0u);
}

TEST_F(ObjectFiles, OneObjectIsReadAsItStandsInAFile) {
  std::mt19937_64 random(9);
  for (int i = 0; i < 200; ++i) {
    const Objects one = randomObjects(random, 1);
    const std::string text = jsonOf(one.view());
    const size_t begin = text.find("[\n") + 2;
    Objects back(kDecals);
    back.append(parseObject(kDecals, text.substr(begin, text.rfind("\n]") - begin)));
    EXPECT_TRUE(sameObjects(back.view(), one.view()));
  }
  const std::string good = R"({"position": [0, 0, 0], "direction": [0, 0, 1]})";
  for (const std::string& bad :
       {std::string(), std::string("{}"), std::string("3"), std::string("[]"), good + "," + good,
        good + "}", good + "]}", good + R"(], "decals": [)" + good, good + R"(], "version": [1)",
        good + R"(], "more": [)" + good, good.substr(1), good.substr(0, good.size() - 1),
        std::string(R"({"position": [0, 0, 0], "direction": [0, 0, 0]})")}) {
    EXPECT_ERROR(ErrorId::kObjectField, parseObject(kDecals, bad));
  }
}

TEST_F(ObjectFiles, WhatCannotBeReadIsRefused) {
  EXPECT_ERROR(ErrorId::kObjectFileUnreadable, load(kDecals, file("missing.json")));
  EXPECT_ERROR(ErrorId::kObjectFileUnreadable, load(kDecals, folder_.string()));
  EXPECT_ERROR(ErrorId::kObjectFileUnreadable, load(kDecals, "/dev/zero"));
  EXPECT_ERROR(ErrorId::kObjectFileUnreadable, load(kDecals, ""));
}

TEST_F(ObjectFiles, OtherEndingsWriteNothing) {
  const Objects none(kDecals);
  for (const char* name : {"a", "a.txt", "a.json.bak", "json", ".json", "a.shots"}) {
    EXPECT_ERROR(ErrorId::kObjectFileEnding, save(none.view(), file(name)));
  }
  EXPECT_EQ(filesInFolder(), 0u);
}

TEST_F(ObjectFiles, WithoutAFolderNothingIsWritten) {
  const Objects none(kDecals);
  EXPECT_ERROR(ErrorId::kFileUnwritable, save(none.view(), file("missing/a.json")));
  fs::create_directory(file("a.json"));
  EXPECT_ERROR(ErrorId::kFileUnwritable, save(none.view(), file("a.json")));
  EXPECT_EQ(filesInFolder(), 1u);
}

// Drops superuser rights while it lives: permissions do not stop the superuser.
class Unprivileged {
 public:
  Unprivileged() {
    if (was_ == 0 && seteuid(65534) != 0) ADD_FAILURE() << "cannot become another user";
  }
  ~Unprivileged() {
    if (seteuid(was_) != 0) std::abort();
  }

 private:
  uid_t was_ = geteuid();
};

TEST_F(ObjectFiles, WithoutPermissionTheOldFileStays) {
  std::mt19937_64 random(6);
  const std::string path = file("a.json");
  save(randomObjects(random, 2).view(), path);
  const std::string old = contentOf(path);
  fs::permissions(folder_, fs::perms(0555));
  {
    const Unprivileged user;
    EXPECT_ERROR(ErrorId::kFileUnwritable, save(Objects(kDecals).view(), path));
  }
  EXPECT_EQ(contentOf(path), old);
  fs::permissions(path, fs::perms::none);
  {
    const Unprivileged user;
    EXPECT_ERROR(ErrorId::kObjectFileUnreadable, load(kDecals, path));
  }
  fs::permissions(folder_, fs::perms(0755));
  EXPECT_EQ(filesInFolder(), 1u);
}

TEST_F(ObjectFiles, AFullDiskLeavesTheOldFile) {
  std::mt19937_64 random(7);
  const Objects objects = randomObjects(random, 1000);
  fileOf("a.json", "old");
  rlimit before;
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto signal = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit little{.rlim_cur = 10000, .rlim_max = before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &little), 0);
  EXPECT_ERROR(ErrorId::kFileUnwritable, save(objects.view(), file("a.json")));
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, signal);
  EXPECT_EQ(contentOf(file("a.json")), "old");
  EXPECT_EQ(filesInFolder(), 1u);
}

TEST_F(ObjectFiles, AFailedLoadKeepsTheList) {
  std::mt19937_64 random(8);
  const Objects objects = randomObjects(random, 5);
  ObjectList list(kDecals);
  list.add(objects.view());
  const uint64_t revision = list.revision();
  const std::string damaged = fileOf("a.json", R"({"version": 1, "decals": [}]})");
  EXPECT_ERROR(ErrorId::kObjectFileInvalid, list.replace(load(kDecals, damaged).view()));
  EXPECT_EQ(list.revision(), revision);
  EXPECT_TRUE(sameObjects(list.view(), objects.view()));
}

}  // namespace
}  // namespace grisaille::objects
