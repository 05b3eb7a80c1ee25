// SPDX-License-Identifier: MIT
#include "lab/claims/expectation.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <vector>

#include "core/base/error.h"
#include "core/base/nearest.h"
#include "lab/claims/metrics.h"
#include "lab/claims/regions.h"

namespace grisaille::lab::claims {
namespace {

std::optional<double> numberOf(const std::string& word) {
  double value = 0;
  const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), value);
  const bool whole = status == std::errc() && end == word.data() + word.size();
  if (!whole || !std::isfinite(value)) return {};
  return value;
}

// Throws unless `word` is one of the keys of `infos`.
template <typename Infos>
void requireKnown(const char* kind, const std::string& word, const Infos& infos) {
  std::vector<std::string> keys;
  for (const auto& info : infos) keys.emplace_back(info.key);
  if (std::ranges::find(keys, word) != keys.end()) return;
  const std::string near = nearest(word, keys);
  throw Error(ErrorId::kUsage, "'{}' is not a {}{}{}", word, kind,
              near.empty() ? "" : ", nearest is ", near);
}

Term termOf(const std::string& word) {
  const size_t dot = word.find('.');
  if (dot == std::string::npos || dot == 0) {
    throw Error(ErrorId::kUsage, "'{}' is not of the form RUN.METRIC or RUN.METRIC@REGION", word);
  }
  const size_t at = std::min(word.find('@', dot), word.size());
  Term term;
  term.run = word.substr(0, dot);
  term.metric = word.substr(dot + 1, at - dot - 1);
  if (at < word.size()) term.region = word.substr(at + 1);
  requireKnown("metric", term.metric, metrics());
  for (size_t from = 0; from <= term.region.size();) {
    const size_t end = std::min(term.region.find('+', from), term.region.size());
    requireKnown("region", term.region.substr(from, end - from), regions());
    from = end + 1;
  }
  return term;
}

}  // namespace

std::string Term::quantity() const {
  return region == "all" ? metric : metric + "@" + region;
}

Expectation parseExpectation(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  const bool sized = words.size() == 3 || (words.size() == 5 && words[3] == "*");
  if (!sized || (words[1] != "<" && words[1] != "<=" && words[1] != ">" && words[1] != ">=")) {
    throw Error(ErrorId::kUsage, "'{}' is not of the form LEFT < [FACTOR *] RIGHT", text);
  }
  Expectation expectation{
      .text = text, .left = termOf(words[0]), .op = words[1], .factor = 1, .right = {}};
  const auto number = numberOf(words[2]);
  if (words.size() == 5 && !number) {
    throw Error(ErrorId::kUsage, "'{}' is not a number, in '{}'", words[2], text);
  }
  if (number) expectation.factor = *number;
  if (words.size() == 5 || !number) expectation.right = termOf(words.back());
  return expectation;
}

bool holds(const Expectation& expectation, const std::function<double(const Term&)>& value) {
  const double left = value(expectation.left);
  const double right = expectation.factor * (expectation.right ? value(*expectation.right) : 1);
  if (expectation.op == "<") return left < right;
  if (expectation.op == "<=") return left <= right;
  if (expectation.op == ">") return left > right;
  return left >= right;
}

}  // namespace grisaille::lab::claims
