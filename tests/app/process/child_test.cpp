// SPDX-License-Identifier: MIT
// Child processes of the viewer.
#include "app/process/child.h"

#include <sys/wait.h>

#include <thread>

#include "tests/support/folder_test.h"

namespace grisaille::app {
namespace {

using ChildTest = tests::FolderTest;

TEST_F(ChildTest, WhatItWritesIsThereWhole) {
  Child child(
      {"sh", "-c", "i=0; while [ $i -lt 20000 ]; do echo $i; i=$((i+1)); done; echo b >&2"});
  child.wait();
  EXPECT_FALSE(child.running());
  EXPECT_EQ(child.status(), 0);
  std::string expected;
  for (int i = 0; i < 20000; ++i) expected += std::to_string(i) + "\n";  // more than a pipe holds
  EXPECT_EQ(child.out(), expected);
  EXPECT_EQ(child.err(), "b\n");
}

TEST_F(ChildTest, ItReadsNothingAndInheritsNothing) {
  const int open = dup(STDERR_FILENO);
  Child child({"sh", "-c", "cat; ls /proc/self/fd"});
  child.wait();
  close(open);
  EXPECT_EQ(child.out(), "0\n1\n2\n3\n");  // ls opens its folder as 3
}

// Also when the parent exits without destroying the object.
TEST_F(ChildTest, ItEndsWithWhoStartedIt) {
  const std::string who = file("who"), part = file("part");
  const pid_t parent = fork();
  if (parent == 0) {
    const Child child(
        {"sh", "-c", "echo $$ > '" + part + "'; mv '" + part + "' '" + who + "'; exec sleep 1000"});
    while (!std::filesystem::exists(who)) std::this_thread::yield();
    _exit(0);
  }
  ASSERT_EQ(waitpid(parent, nullptr, 0), parent);
  const std::string stat = "/proc/" + std::to_string(std::stoi(contentOf(who))) + "/stat";
  const auto ended = [&] {  // whichever process reaps it
    const std::string content = contentOf(stat);
    return content.empty() || content.find(") Z") != std::string::npos;
  };
  while (!ended()) std::this_thread::sleep_for(std::chrono::milliseconds(2));
}

}  // namespace
}  // namespace grisaille::app
