// SPDX-License-Identifier: MIT
// Every example of an effect: it is small, `--verify` finds no fault, and the commands of its
// README print its table and draw its picture.
#include <algorithm>

#include "tests/build/session.h"
#include "tests/examples/built.h"

namespace grisaille::tests {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = SOURCE_FOLDER;

class ExampleFolder : public ::testing::TestWithParam<std::string> {
 protected:
  static fs::path folder() { return kSource / "examples" / GetParam(); }
};
INSTANTIATE_TEST_SUITE_P(, ExampleFolder,
                         ::testing::Values("contact_shadows", "decals", "depth_of_field",
                                           "temporal_aa"),
                         [](const auto& of) { return of.param; });

TEST_P(ExampleFolder, HasAtMost300Lines) {
  size_t lines = 0;
  for (const auto& entry : fs::directory_iterator(folder())) {
    if (entry.path().extension() == ".md") continue;
    lines += static_cast<size_t>(std::ranges::count(readFile(entry.path()), '\n'));
  }
  EXPECT_GT(lines, 200u);
  EXPECT_LE(lines, 300u);
}

TEST_P(ExampleFolder, BuildsAnEffectWithoutAFault) {
  GRISAILLE_NEEDS_INSTALLATION();
  const TemporaryFolder here;
  const Outcome outcome = runProgram(
      {"effects", "--verify", builtExample(GetParam()) + "/" + GetParam() + ".so"}, here.path());
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  EXPECT_NE(outcome.out.find(" 0 faults"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("ok    opengl: "), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("ok    vulkan: "), std::string::npos) << outcome.out;
}

TEST_P(ExampleFolder, ReadmeRunsAndShowsItsPicture) {
  GRISAILLE_NEEDS_INSTALLATION();
  const TemporaryFolder here;
  const std::string script = here.write(
      "readme.sh", "export PATH='" + installedPrefix() + "/bin':\"$PATH\"\ncp -r '" +
                       folder().string() + "' mine\ncd mine\n" + sessionOf(folder() / "README.md"));
  const Outcome outcome = runShell("bash " + script, here.path());
  ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  const std::string picture = GetParam() + ".png";
  EXPECT_LT(image::shareOver(image::read(here / ("mine/" + picture)),
                             image::read(kSource / "docs/pictures" / picture), 8.0 / 255),
            0.002);
  const Outcome table = runShell("GRISAILLE_EFFECT_PATH='" + builtExample(GetParam()) +
                                     "' grisaille effects --markdown " + GetParam(),
                                 ".");
  EXPECT_NE(readFile(folder() / "README.md").find(table.out), std::string::npos)
      << "lacks this table:\n"
      << table.out;
}

}  // namespace
}  // namespace grisaille::tests
