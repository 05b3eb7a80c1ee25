// SPDX-License-Identifier: MIT
// grisaille: screen-space effects whose error is measured. See README.md.
#include <cstdio>
#include <exception>
#include <new>

#include "app/command.h"
#include "app/truth/interruption.h"
#include "core/error.h"

int main(int argc, char** argv) {
  CLI::App program("Screen-space effects whose error is measured", "grisaille");
  program.set_version_flag("--version", GRISAILLE_VERSION);
  program.require_subcommand(1);
  program.failure_message([](const CLI::App*, const CLI::Error& error) {
    return std::string(grisaille::Error(grisaille::ErrorId::kUsage, error.what()).what()) + "\n";
  });
  grisaille::app::addRender(program);
  grisaille::app::addApply(program);
  grisaille::app::addView(program);
  grisaille::app::addEffects(program);
  grisaille::app::addNewEffect(program);
  grisaille::app::addBackends(program);
  grisaille::app::addTruth(program);
  grisaille::app::addMeasure(program);
  grisaille::app::addTune(program);
  grisaille::app::addClaims(program);
  grisaille::app::addStability(program);
  grisaille::app::addScene(program);
  grisaille::app::addCompletion(program);
  try {
    program.parse(argc, argv);
    return 0;
  } catch (const CLI::ParseError& error) {
    // Help and version come this way too, with status 0.
    return program.exit(error) == 0 ? 0 : 2;
  } catch (const grisaille::app::truth::Interrupted&) {
    return grisaille::app::truth::Interrupted::kStatus;
  } catch (const grisaille::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "%s\n",
                 grisaille::Error(grisaille::ErrorId::kOutOfMemory, "memory ran out").what());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n",
                 grisaille::Error(grisaille::ErrorId::kUnexpected, error.what()).what());
  }
  return 1;
}
