// SPDX-License-Identifier: MIT
// Session files of the viewer.
#include "app/viewer/session_file.h"
#include "tests/fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace grisaille;
  app::viewer::SavedSession session;
  const bool good = fuzz::accepted({ErrorId::kSessionFile}, [&] {
    session = app::viewer::parseSession(fuzz::textOf(data, size), "/nowhere");
  });
  if (!good) return 0;
  const std::string text = app::viewer::sessionJson(session, "/nowhere");
  fuzz::require(app::viewer::sessionJson(app::viewer::parseSession(text, "/nowhere"), "/nowhere") ==
                text);
  return 0;
}
