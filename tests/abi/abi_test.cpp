// SPDX-License-Identifier: MIT
// The binary interface of the installed headers is that of docs/abi.txt, and the comparison names
// each kind of change.
#include "tests/abi/abi.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "tests/program/run.h"

namespace grisaille::tests {
namespace {

class Abi : public ::testing::Test {
 protected:
  void SetUp() override {
    if (runShell("command -v clang", ".").status != 0) GTEST_SKIP() << "clang is not installed";
  }
};

TEST_F(Abi, HeadersAreThoseOfTheTable) {
  const AbiChanges changes = abiChanges(readFile(ABI_TABLE), abiTable(kHeaders, ABI_OPTIONS));
  for (const std::string& change : changes.breaks) {
    ADD_FAILURE() << "breaks programs that exist: " << change;
  }
  for (const std::string& change : changes.grows) {
    ADD_FAILURE() << change << "; if you mean it, run ./dev abi";
  }
}

TEST_F(Abi, TableHoldsEveryKindOfDeclaration) {
  const std::string table = readFile(ABI_TABLE);
  for (const char* line :
       {"\nGRISAILLE_MAGIC: 0x53495247u\n",
        "\nGRISAILLE_READS: (attachment) (1u << (attachment))\n",
        "\nGRISAILLE_HIT_SURFACE: 1 of grisaille_hit_kind\n", "\ngrisaille_ray: 40 bytes\n",
        "\ngrisaille_ray.direction: at 24, 12 bytes, float[3]\n",
        "\ngrisaille_host_version: uint32_t (void)\n"}) {
    EXPECT_NE(table.find(line), std::string::npos) << line;
  }
}

// Each change to this header, and the line that reports it.
constexpr const char* kHeader =
    "#include <stdint.h>\n"
    "#define GRISAILLE_MAGIC 7u\n"
    "#define GRISAILLE_ABI_MINOR 2u\n"
    "typedef enum grisaille_kind { GRISAILLE_A = 0, GRISAILLE_B = 1, GRISAILLE_KIND_COUNT = 2 } "
    "grisaille_kind;\n"
    "typedef struct grisaille_sized { uint32_t struct_size; double x; uint32_t y; } "
    "grisaille_sized;\n"
    "typedef struct grisaille_point { float x; float y; } grisaille_point;\n"
    "uint32_t grisaille_get(const grisaille_point* point);\n";

struct Change {
  const char *name, *from, *to;
  bool breaks;
  const char* report;
};

class AbiChange : public Abi, public ::testing::WithParamInterface<Change> {};

INSTANTIATE_TEST_SUITE_P(
    , AbiChange,
    ::testing::Values(
        Change{"MemberMoves", "double x; uint32_t y;", "uint32_t y; double x;", true,
               "grisaille_sized.y was at 16, 4 bytes, uint32_t, and is at 4, 4 bytes, uint32_t"},
        Change{"MemberGoes", "float x; float y;", "float x;", true,
               "grisaille_point.y is gone; it was at 4, 4 bytes, float"},
        Change{"MemberIsRenamed", "float y;", "float why;", true, "grisaille_point.y is gone"},
        Change{"MemberChangesItsType", "double x; uint32_t y;", "double x; int32_t y;", true,
               "grisaille_sized.y was at 16, 4 bytes, uint32_t, and is at 16, 4 bytes, int32_t"},
        Change{"MemberIsInserted", "double x; uint32_t y;", "double x; double between; uint32_t y;",
               true, "grisaille_sized.between is new: at 16, 8 bytes, double"},
        // The struct of an earlier version has its size, and anything in these bytes.
        Change{"MemberFillsThePadding", "uint32_t y; }", "uint32_t y; uint32_t z; }", true,
               "grisaille_sized.z is new: at 20, 4 bytes, uint32_t"},
        Change{"MemberIsAppendedBeyondTheSize", "uint32_t y; }", "uint32_t y; double z; }", false,
               "grisaille_sized.z is new: at 24, 8 bytes, double"},
        Change{"StructWithoutASizeGrows", "float y; }", "float y; float z; }", true,
               "grisaille_point was 8 bytes, and is 12 bytes"},
        Change{"ValueOfAnEnumChanges", "GRISAILLE_B = 1", "GRISAILLE_B = 3", true,
               "GRISAILLE_B was 1 of grisaille_kind, and is 3 of grisaille_kind"},
        Change{"ValueOfAnEnumIsAdded", "GRISAILLE_KIND_COUNT = 2",
               "GRISAILLE_C = 2, GRISAILLE_KIND_COUNT = 3", false,
               "GRISAILLE_C is new: 2 of grisaille_kind"},
        Change{"ConstantChanges", "MAGIC 7u", "MAGIC 8u", true,
               "GRISAILLE_MAGIC was 7u, and is 8u"},
        Change{"MinorNumberRises", "MINOR 2u", "MINOR 3u", false,
               "GRISAILLE_ABI_MINOR was 2u, and is 3u"},
        Change{"MinorNumberFalls", "MINOR 2u", "MINOR 1u", true,
               "GRISAILLE_ABI_MINOR was 2u, and is 1u"},
        Change{"FunctionTakesMore", "* point);", "* point, int more);", true,
               "grisaille_get was uint32_t (const grisaille_point *), and is"},
        Change{"FunctionIsAdded", "uint32_t grisaille_get",
               "void grisaille_set(double x);\nuint32_t grisaille_get", false,
               "grisaille_set is new: void (double)"},
        Change{"FunctionTypeIsAdded", "uint32_t grisaille_get",
               "typedef void (*grisaille_call)(int);\nuint32_t grisaille_get", false,
               "grisaille_call is new: void (*)(int)"}),
    [](const auto& test) { return test.param.name; });

TEST_P(AbiChange, IsReported) {
  const Change& change = GetParam();
  std::string header = kHeader;
  const size_t at = header.find(change.from);
  ASSERT_NE(at, std::string::npos);
  header.replace(at, std::strlen(change.from), change.to);
  static const std::string kBefore = abiTable(kHeader, "");
  const AbiChanges changes = abiChanges(kBefore, abiTable(header, ""));
  const std::vector<std::string>& reports = change.breaks ? changes.breaks : changes.grows;
  EXPECT_TRUE(std::ranges::any_of(reports, [&](const std::string& report) {
    return report.starts_with(change.report);
  })) << ::testing::PrintToString(reports);
  EXPECT_EQ(changes.breaks.empty(), !change.breaks) << ::testing::PrintToString(changes.breaks);
}

}  // namespace
}  // namespace grisaille::tests
