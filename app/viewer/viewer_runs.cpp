// SPDX-License-Identifier: MIT
// The commands that the viewer runs in the background: `grisaille tune`, and `grisaille render` for
// a sequence.
#include <utility>

#include "app/viewer/viewer.h"

namespace grisaille::app::viewer {

void Viewer::startTune(const TuneWish& wish) {
  session_.attempt("search", [&] {
    tune_.start(session_.tuneCommand(wish, place().size, backend_, deviceName()));
    tuning_ = {.effect = wish.effect, .running = true, .state = tune_.state(), .outcome = {}};
  });
}

// True if the search has news.
bool Viewer::lookAtTune() {
  if (!tuning_.running) return false;
  const auto outcome = tune_.take();
  if (!outcome) {
    const std::string before = std::exchange(tuning_.state, tune_.state()).text;
    return tuning_.state.text != before;
  }
  tuning_.running = false;
  tuning_.outcome = *outcome;
  session_.attempt("search", [&] {
    if (outcome->values) session_.takeTuned(tuning_.effect, *outcome->values);
  });
  return true;
}

void Viewer::startSequence() {
  session_.attempt("sequence", [&] {
    const glm::uvec2 size = panel_.pictureAsShown ? place().size : panel_.pictureSize;
    const std::vector<std::string> words =
        renderArguments(session_.sequenceCommand(size, backend_, deviceName()));
    sequence_.start({words.begin() + 1, words.end()});  // without the program's name
    const Sequence& sequence = session_.sequence;
    sequenceFile_ = sequence.filmed ? sequence.video : sequence.file;
    session_.say(quotedLine(words));
  });
}

// True if the sequence has news.
bool Viewer::lookAtSequence() {
  if (!sequence_.started()) return false;
  const auto ended = sequence_.take();
  if (!ended) {
    const std::string before = std::exchange(sequenceText_, sequence_.state().text);
    return sequenceText_ != before;
  }
  // The command's own error has its number.
  session_.conclude("sequence", ended->failure.empty() || ended->failure.starts_with("error ")
                                    ? ended->failure
                                    : "the sequence: " + ended->failure);
  if (ended->failure.empty()) session_.say("the sequence is written: " + sequenceFile_);
  return true;
}

}  // namespace grisaille::app::viewer
