// SPDX-License-Identifier: MIT
#include "core/shots/shot_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/shots/shot_list.h"
#include "tests/core/shots/random_shots.h"
#include "tests/core/shots/temporary_folder.h"
#include "tests/support/expect_error.h"

namespace grisaille::shots {
namespace {

namespace fs = std::filesystem;

class ShotFiles : public FolderTest {};

TEST_F(ShotFiles, EveryBitComesBack) {
  for (const char* name : {"a.json", "a.shots", "A.JSON", "A.Shots"}) {
    for (const size_t count : {0, 1, 2, 37, 5000}) {
      std::mt19937_64 random(count);
      const std::vector<grisaille_shot> shots = randomShots(random, count);
      save(shots, file(name));
      EXPECT_TRUE(sameShots(load(file(name)), shots)) << name << " of " << count;
    }
  }
  EXPECT_EQ(filesInFolder(), 4u);
}

// Floats whose fewest digits do not lead back to them by way of a double, and their neighbours.
TEST_F(ShotFiles, HardFloatsComeBack) {
  std::vector<grisaille_shot> shots;
  for (uint32_t bits = 0x15ae43fd - 100; bits < 0x15ae43fd + 100; ++bits) {
    grisaille_shot shot = makeShot({.direction = {1, 0, 0}});
    std::memcpy(&shot.color[0], &bits, sizeof bits);
    std::memcpy(&shot.direction[1], &bits, sizeof bits);
    std::memcpy(&shot.range, &bits, sizeof bits);
    shots.push_back(shot);
  }
  save(shots, file("a.json"));
  EXPECT_TRUE(sameShots(load(file("a.json")), shots));
}

TEST_F(ShotFiles, JsonIsAsDescribed) {
  ShotValues values{.origin = {0.1, -2, 3e8}, .direction = {0, 3, 0}, .color = {0.1, 1, 0}};
  std::vector<grisaille_shot> shots = {makeShot(values)};
  values.range = 0.3;
  shots.push_back(makeShot(values));
  save(shots, file("a.json"));
  const auto written = nlohmann::json::parse(contentOf(file("a.json")));
  const auto expected = nlohmann::json::parse(R"({"version": 1, "shots": [
    {"origin": [0.1, -2, 3e8], "direction": [0, 1, 0], "color": [0.1, 1, 0]},
    {"origin": [0.1, -2, 3e8], "direction": [0, 1, 0], "color": [0.1, 1, 0], "range": 0.3}]})");
  EXPECT_EQ(written, expected);
}

TEST_F(ShotFiles, BinaryIsAsDescribed) {
  const grisaille_shot shot =
      makeShot({.origin = {1, 0, -2}, .direction = {0, -1, 0}, .color = {1, 0.5, 0}, .range = 8});
  save(std::span(&shot, 1), file("a.shots"));
  const unsigned char expected[] = {
      0x89, 'G', 'R',  'S',  'H', '\r', '\n', 0x1a,              // magic
      1,    0,   0,    0,                                        // version
      1,    0,   0,    0,    0,   0,    0,    0,                 // count
      0,    0,   0,    0,    0,   0,    0xf0, 0x3f,              // origin
      0,    0,   0,    0,    0,   0,    0,    0,                 //
      0,    0,   0,    0,    0,   0,    0,    0xc0,              //
      0,    0,   0,    0,    0,   0,    0x80, 0xbf, 0, 0, 0, 0,  // direction
      0,    0,   0x80, 0x3f, 0,   0,    0,    0x3f, 0, 0, 0, 0,  // color
      0,    0,   0,    0x41};                                    // range
  const std::string content = contentOf(file("a.shots"));
  ASSERT_EQ(content.size(), sizeof expected + 8);
  EXPECT_EQ(std::memcmp(content.data(), expected, sizeof expected), 0);
  uint64_t hash = 14695981039346656037u;
  for (const unsigned char byte : expected) hash = (hash ^ byte) * 1099511628211u;
  for (size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(static_cast<unsigned char>(content[sizeof expected + i]), hash >> (8 * i) & 0xff);
  }
}

TEST_F(ShotFiles, TheContentTellsTheFormat) {
  std::mt19937_64 random(1);
  const std::vector<grisaille_shot> shots = randomShots(random, 3);
  save(shots, file("a.json"));
  save(shots, file("a.shots"));
  fs::rename(file("a.json"), file("swap"));
  fs::rename(file("a.shots"), file("a.json"));
  fs::rename(file("swap"), file("a.shots"));
  EXPECT_TRUE(sameShots(load(file("a.json")), shots));
  EXPECT_TRUE(sameShots(load(file("a.shots")), shots));
}

TEST_F(ShotFiles, HandWrittenJsonIsRead) {
  const auto shots = load(fileOf("a.json", R"({
    "shots": [{"color": [0, 1, 1e-1], "range": 0, "direction": [0, 0, -1e300],
               "origin": [10000000000e-1, -0.0, 5]},
              {"origin": [0, 0, 0], "direction": [3, 0, 4e0], "color": [0, 0, 0], "range": 2}],
    "version": 1.0})"));
  ASSERT_EQ(shots.size(), 2u);
  EXPECT_TRUE(sameShot(
      shots[0],
      makeShot({.origin = {1e9, -0.0, 5}, .direction = {0, 0, -1}, .color = {0, 1, 0.1}})));
  EXPECT_EQ(shots[1].direction[0], 0.6f);
  EXPECT_EQ(shots[1].range, 2.0f);
  EXPECT_TRUE(load(fileOf("b.json", "\xEF\xBB\xBF{\"version\":1,\"shots\":[]}\n")).empty());
}

TEST_F(ShotFiles, WhatCannotBeReadIsRefused) {
  EXPECT_ERROR(ErrorId::kShotFileUnreadable, load(file("missing.json")));
  EXPECT_ERROR(ErrorId::kShotFileUnreadable, load(folder_.string()));
  EXPECT_ERROR(ErrorId::kShotFileUnreadable, load("/dev/zero"));
  EXPECT_ERROR(ErrorId::kShotFileUnreadable, load(""));
}

TEST_F(ShotFiles, OtherEndingsWriteNothing) {
  for (const char* name : {"a", "a.txt", "a.json.bak", "json", ".json", "a.shots/"}) {
    EXPECT_ERROR(ErrorId::kShotFileEnding, save({}, file(name)));
  }
  EXPECT_EQ(filesInFolder(), 0u);
}

TEST_F(ShotFiles, BadShotsAreNotWritten) {
  grisaille_shot bad = makeShot({.direction = {1, 0, 0}});
  bad.origin[0] = std::numeric_limits<double>::quiet_NaN();
  for (const char* name : {"a.json", "a.shots"}) {
    fileOf(name, "old");
    EXPECT_ERROR(ErrorId::kShotOrigin, save(std::span(&bad, 1), file(name)));
    EXPECT_EQ(contentOf(file(name)), "old");
  }
}

TEST_F(ShotFiles, WithoutAFolderNothingIsWritten) {
  EXPECT_ERROR(ErrorId::kFileUnwritable, save({}, file("missing/a.json")));
  fs::create_directory(file("a.shots"));
  EXPECT_ERROR(ErrorId::kFileUnwritable, save({}, file("a.shots")));
  EXPECT_EQ(filesInFolder(), 1u);
}

// As another user than the superuser, whom no permission stops.
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

TEST_F(ShotFiles, WithoutPermissionTheOldFileStays) {
  std::mt19937_64 random(6);
  for (const char* name : {"a.json", "a.shots"}) {
    save(randomShots(random, 2), file(name));
    const std::string old = contentOf(file(name));
    fs::permissions(folder_, fs::perms(0555));
    {
      const Unprivileged user;
      EXPECT_ERROR(ErrorId::kFileUnwritable, save({}, file(name)));
    }
    EXPECT_EQ(contentOf(file(name)), old);
    fs::permissions(file(name), fs::perms::none);
    {
      const Unprivileged user;
      EXPECT_ERROR(ErrorId::kShotFileUnreadable, load(file(name)));
    }
    fs::permissions(folder_, fs::perms(0755));
  }
  EXPECT_EQ(filesInFolder(), 2u);
}

TEST_F(ShotFiles, AFullDiskLeavesTheOldFile) {
  std::mt19937_64 random(7);
  const std::vector<grisaille_shot> shots = randomShots(random, 1000);
  for (const char* name : {"a.json", "a.shots"}) {
    fileOf(name, "old");
    rlimit before;
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto signal = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit little{.rlim_cur = 10000, .rlim_max = before.rlim_max};
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &little), 0);
    EXPECT_ERROR(ErrorId::kFileUnwritable, save(shots, file(name)));
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
    std::signal(SIGXFSZ, signal);
    EXPECT_EQ(contentOf(file(name)), "old");
  }
  EXPECT_EQ(filesInFolder(), 2u);
}

TEST_F(ShotFiles, AFailedLoadKeepsTheList) {
  std::mt19937_64 random(8);
  const std::vector<grisaille_shot> shots = randomShots(random, 5);
  ShotList list;
  list.fire(shots);
  const uint64_t revision = list.revision();
  const std::string damaged = fileOf("a.json", R"({"version": 1, "shots": [}]})");
  EXPECT_ERROR(ErrorId::kShotFileInvalid, list.replace(load(damaged)));
  EXPECT_EQ(list.revision(), revision);
  EXPECT_TRUE(sameShots(list.shots(), shots));
}

}  // namespace
}  // namespace grisaille::shots
