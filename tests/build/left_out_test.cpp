// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "app/command.h"
#include "core/trace/ray_tracer.h"
#include "tests/support/expect_error.h"

namespace grisaille::tests {
namespace {

TEST(LeftOut, RaysSayWhichOptionBringsThem) {
  const scene::Scene scene;
  try {
    const trace::RayTracer tracer(scene, glm::dvec3(0));
    FAIL() << "a tracer was created";
  } catch (const Error& error) {
    EXPECT_EQ(error.id(), ErrorId::kLeftOut);
    EXPECT_NE(error.detail().find("GRISAILLE_TRUTH"), std::string::npos) << error.what();
  }
}

TEST(LeftOut, ViewSaysWhichOptionBringsIt) {
  CLI::App program;
  app::addView(program);
  EXPECT_ERROR(ErrorId::kLeftOut, program.parse("view scene.glb --size 640x360", false));
}

}  // namespace
}  // namespace grisaille::tests
