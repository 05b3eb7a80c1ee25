// SPDX-License-Identifier: MIT
// grisaille: screen-space effects whose error is measured. See README.md.
#include <signal.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <new>

#include "app/command.h"
#include "app/last_words.h"
#include "app/truth/interruption.h"
#include "core/error.h"

namespace {

using grisaille::Error;
using grisaille::ErrorId;

void addCommands(CLI::App& program) {
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
}

// Tables go there: a full disk behind it must not pass for success.
void requireStandardOutput() {
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
  throw Error(ErrorId::kFileUnwritable, "standard output: {}",
              errno != 0 ? std::strerror(errno) : "not all of it was taken");
}

// What fmt throws where it prints to a file that takes no more is no fault of the program's.
Error asError(const std::exception& error) {
  const bool printing = std::ferror(stdout) != 0;
  if (printing) return {ErrorId::kFileUnwritable, fmt::format("standard output: {}", error.what())};
  return {ErrorId::kUnexpected, error.what()};
}

}  // namespace

int main(int argc, char** argv) {
  grisaille::app::nameCrashes();
  signal(SIGXFSZ, SIG_IGN);  // a limit of files' sizes is an error of the write, and has a line
  CLI::App program("Screen-space effects whose error is measured", "grisaille");
  program.set_version_flag("--version", GRISAILLE_VERSION);
  program.require_subcommand(1);
  program.failure_message([](const CLI::App*, const CLI::Error& error) {
    return std::string(Error(ErrorId::kUsage, error.what()).what()) + "\n";
  });
  addCommands(program);
  try {
    program.parse(argc, argv);
    requireStandardOutput();
    return 0;
  } catch (const CLI::ParseError& error) {
    // Help and version come this way too, with status 0.
    return program.exit(error) == 0 ? 0 : 2;
  } catch (const grisaille::app::truth::Interrupted&) {
    return grisaille::app::truth::Interrupted::kStatus;
  } catch (const Error& error) {
    fmt::print(stderr, "{}\n", error.what());
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "{}\n", Error(ErrorId::kOutOfMemory, "memory ran out").what());
  } catch (const std::filesystem::filesystem_error& error) {
    fmt::print(stderr, "{}\n", Error(ErrorId::kFileUnwritable, error.what()).what());
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", asError(error).what());
  }
  return 1;
}
