// SPDX-License-Identifier: MIT
// docs/api.md is what the headers' comments make.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <string>
#include <vector>

#include "tests/program/run.h"

namespace grisaille::tests {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = SOURCE_FOLDER;

std::string pageOf(const std::vector<fs::path>& headers) {
  std::string line = "'" BUILD_FOLDER "/bin/grisaille_api_page'";
  for (const fs::path& header : headers) line += " '" + header.string() + "'";
  const Outcome outcome = runShell(line, ".");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return outcome.out;
}

TEST(ApiPage, IsMadeOfTheHeaders) {
  const fs::path abi = kSource / "core/effect/include/grisaille";
  const std::string page =
      pageOf({kSource / "host/include/grisaille/host.h", abi / "effect.h", abi / "shader.h"});
  EXPECT_TRUE(page == readFile(kSource / "docs/api.md")) << "run `./dev api`";
  // Every function of both interfaces says something.
  const std::regex silent("\\| `[^`]*\\(\\*[^`]*` \\|  \\|");
  std::smatch match;
  EXPECT_FALSE(std::regex_search(page, match, silent)) << match.str();
}

// One of each kind of declaration.
TEST(ApiPage, TakesUnitsOwnershipAndErrorsFromComments) {
  const TemporaryFolder folder;
  const std::string header = folder.write("small.h",
                                          R"(/* SPDX-License-Identifier: MIT
 *
 * What it is.
 */
#ifndef SMALL_H
#define SMALL_H
#define SMALL_MOST 7 /* of anything */
/* ---- Things --------------------------------------------------------------------------------- */

/* Somebody's. */
typedef struct thing thing;
typedef enum kind { KIND_ONE = 1, /* a | b */ KIND_TWO = 2 /* the last */ } kind;
typedef struct part {
  double length; /* metres,
                    over 0 */
  /* Before it. */
  int (*call)(int a, int b);
} part;
/* Makes one. Errors: 5601 (a null pointer). */
GRISAILLE_EXPORT int make(const part* of, thing** out);
#endif
)");
  const std::string page = pageOf({header});
  for (const char* expected :
       {"What it is.\n", "| `SMALL_MOST` | `7` | of anything |", "### Things\n",
        "#### `thing`\n\nOpaque. Somebody's.", "| `KIND_ONE = 1` | a \\| b |",
        "| `KIND_TWO = 2` | the last |", "| `double length` | metres, over 0 |",
        "| `int (*call)(int a, int b)` | Before it. |",
        "#### `make()`\n\n```c\nint make(const part* of, thing** out);\n```\n\nMakes one.\n\n",
        "Makes one.\n\n**Errors:** 5601 (a null pointer).",
        "| 5601 | give what the message names |"}) {
    EXPECT_NE(page.find(expected), std::string::npos) << expected << " is not in\n" << page;
  }
  folder.write("odd.h", "/* MIT */ int nothing(void);");
  EXPECT_EQ(runShell("'" BUILD_FOLDER "/bin/grisaille_api_page' odd.h", folder.path()).status, 1);
}

}  // namespace
}  // namespace grisaille::tests
