// SPDX-License-Identifier: MIT
#include "app/process/program.h"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <new>

#include "app/process/crash_report.h"
#include "app/truth/interruption.h"
#include "core/base/error.h"
#include "core/base/note.h"

namespace grisaille::app {
namespace {

constexpr int kUsageStatus = 2;  // exit status of E5101, from CLI11 or from a command

// Opens /dev/null for each standard stream that is closed at the start. Otherwise a file opened
// later would get the stream's descriptor, and messages would go into that file. Standard output is
// opened read-only: printing a table that nobody can read must fail.
void occupyClosedStreams() {
  constexpr int kModes[] = {O_RDONLY, O_RDONLY, O_WRONLY};
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) < 0) open("/dev/null", kModes[stream]);  // the lowest free number
  }
}

// Throws if standard output failed: a table cut off by a full disk is not a success.
void requireStandardOutput() {
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
  throw Error(ErrorId::kFileUnwritable, "standard output: {}",
              errno == EBADF ? "it is closed"
              : errno != 0   ? std::strerror(errno)
                             : "not all of it was written");
}

// An exception of fmt while standard output fails is a write error, not a fault of the program.
Error asError(const std::exception& error) {
  const bool printing = std::ferror(stdout) != 0;
  if (printing) return {ErrorId::kFileUnwritable, fmt::format("standard output: {}", error.what())};
  return {ErrorId::kUnexpected, error.what()};
}

// Does not use fmt::print(), which throws if standard error cannot be written.
void tell(const Error& error) {
  std::fputs(error.what(), stderr);
  std::fputc('\n', stderr);
}

// Runs the command. Returns the exit status.
int run(CLI::App& program, int argc, char** argv) {
  int status = 0;
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // --help and --version are parse errors of CLI11 too, with status 0.
    status = program.exit(error) == 0 ? 0 : kUsageStatus;
  }
  if (status == 0) requireStandardOutput();
  return status;
}

}  // namespace

int runProgram(int argc, char** argv, const ProgramDesc& desc) {
  occupyClosedStreams();
  nameCrashes();
  signal(SIGXFSZ, SIG_IGN);  // over the limit of file sizes, write() fails and causes an error line
  setNoteListener(
      [](const std::string& line) { std::fputs(("note: " + line + "\n").c_str(), stderr); });
  CLI::App program(desc.description, desc.name);
  program.set_version_flag("--version", desc.version);
  program.require_subcommand(1);
  program.failure_message([](const CLI::App*, const CLI::Error& error) {
    return std::string(Error(ErrorId::kUsage, error.what()).what()) + "\n";
  });
  desc.addCommands(program);
  try {
    return run(program, argc, argv);
  } catch (const truth::Interrupted&) {
    return truth::Interrupted::kStatus;
  } catch (const Error& error) {
    tell(error);
    if (error.id() == ErrorId::kUsage) return kUsageStatus;
  } catch (const std::bad_alloc&) {
    tell({ErrorId::kOutOfMemory, "memory ran out"});
  } catch (const std::filesystem::filesystem_error& error) {
    tell({ErrorId::kFileUnwritable, error.what()});
  } catch (const std::exception& error) {
    tell(asError(error));
  }
  return 1;
}

}  // namespace grisaille::app
